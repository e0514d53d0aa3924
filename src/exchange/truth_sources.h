// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <vector>

#include "enfilade/exchange/ground_truth.h"

namespace enfilade {

using TruthSegment = std::array<Eigen::Vector2d, 2>;

// The sources. `folder` is where the pictures are.
[[nodiscard]] GroundTruth ReadFloorplanTruth(const std::filesystem::path& path,
                                             const std::filesystem::path& folder);
[[nodiscard]] GroundTruth ReadZindTruth(const std::filesystem::path& path, double camera_height_m);
[[nodiscard]] GroundTruth ReadObjTruth(const std::filesystem::path& path);

/// The edges of the region's rings less what the gaps cover: a gap is cut out of an edge that it is
/// parallel to within 20° and no further from than `tolerance_m`. Remains under 1 cm are dropped.
[[nodiscard]] std::vector<TruthSegment> CutGaps(const MultiPolygon2& region,
                                                std::span<const TruthSegment> gaps,
                                                double tolerance_m);

/// One door for each cluster of doors whose centres are linked by steps of at most 0.4 m: the mean
/// of their ends, in the order of the clusters' first doors.
[[nodiscard]] std::vector<TruthSegment> MergeDoors(std::span<const TruthSegment> doors);

}  // namespace enfilade
