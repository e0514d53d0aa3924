// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "apps/enfilade/judge.h"
#include "enfilade/baselines/orientation_map.h"

namespace enfilade {

/// Accuracies of floor, wall and ceiling against the truth, as `label_accuracy` has them.
struct RivalLabels {
  std::optional<double> profile;      ///< what the wall profiles imply
  std::optional<double> superpixels;  ///< of the run's classification, if it made one
  std::optional<double> orientation;  ///< of the orientation maps, undefined pixels being wrong
  /// Of the maps with every undefined pixel labelled like the nearest defined one of its column.
  std::optional<double> orientation_completed;
};

/// Makes the orientation map of every panorama of a result folder, which the caller has locked, and
/// writes their labels and pictures to baselines/orientation/ (as structure/labels_NNNN_*: "final"
/// is the map, "free_space" the completed one). Judges them where there is a truth. Pictures that
/// are no panoramas are left out. Throws InvalidInputError where there is no structure, IoError.
[[nodiscard]] RivalLabels MakeOrientationMaps(const Workspace& workspace, const Results& results,
                                              const std::optional<GroundTruth>& truth,
                                              const OrientationMapOptions& options,
                                              RunContext& context);

/// One line for the terminal.
[[nodiscard]] std::string FormatRivalLabels(const RivalLabels& labels);

}  // namespace enfilade
