// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "enfilade/structure/column_scores.h"
#include "enfilade/structure/plane_viterbi.h"

namespace enfilade {

/// How far each column's wall is to be believed, 0–1: the mean response of `lines` along the whole
/// wall (the neighbouring columns on one plane), 1 from `clear_response` on, times the mean of this
/// over the panorama: where much of a path fails to explain the picture, the rest fits by chance.
/// The path through the columns always says something, also where a picture taken from inside a
/// cupboard shows neither floor nor ceiling; there the lines along its walls are weak. A short wall
/// seen through a door is judged by its own columns alone.
///
/// Columns that the picture does not cover (`is_seen` 0) have no say in their wall's mean. Columns
/// whose family has no scores are believed, and all of them when `clear_response` is zero. One
/// value a column of the path.
[[nodiscard]] std::vector<float> WallConfidence(const WallPath& path, const ColumnScores& lines,
                                                std::span<const uint8_t> is_seen,
                                                const DistanceBins& bins, double clear_response);

}  // namespace enfilade
