// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "enfilade/structure/classify.h"

namespace enfilade {

/// Writes labels_NNNN_points.png, …_free_space.png and …_final.png: grey values are SurfaceLabels,
/// as in a home's truth/labels. Throws IoError.
void WriteLabelMaps(const std::filesystem::path& folder, int view_idx, const LabelMaps& maps);

/// None where there are none. Throws IoError, and InvalidInputError for maps that are broken, of
/// unlike sizes or hold other values.
[[nodiscard]] std::optional<LabelMaps> ReadLabelMaps(const std::filesystem::path& folder,
                                                     int view_idx);

/// Writes labels_NNNN.jpg for people: the picture of a panorama three times, tinted by the labels
/// of each stage (floor green, wall red, ceiling blue; not yet known: untinted). `picture` is rows
/// × 2·rows × 3. Throws IoError.
void WriteLabelPicture(const std::filesystem::path& folder, int view_idx, const LabelMaps& maps,
                       const ImageU8& picture);

}  // namespace enfilade
