// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "enfilade/evaluate/comparison.h"
#include "enfilade/geometry/polygon2.h"

namespace enfilade {

/// The label maps of one panorama as pictures (JPEG files), empty where there is none.
struct LabelSheet {
  std::string picture;  ///< printable name
  std::string photo_jpeg;
  std::string points_jpeg, free_space_jpeg, final_jpeg;  ///< the stages of the classification
  std::string orientation_jpeg;
};

/// Labels of superpixels and orientation maps of all panoramas, with their accuracies against the
/// truth: medians over panoramas, none without one.
struct ComparedLabels {
  std::optional<double> points, free_space, superpixels, profiles;
  std::optional<double> orientation, orientation_completed;
  std::vector<LabelSheet> sheets;
  std::string reason;  ///< why there are no sheets; empty when there are
};

/// The accuracies, null where there is none.
[[nodiscard]] nlohmann::json LabelsToJson(const ComparedLabels& labels);

/// One line for the terminal.
[[nodiscard]] std::string FormatLabels(const ComparedLabels& labels);

/// All that the page shows. Regions and places in the home frame, metres.
struct ComparisonPage {
  std::string title;
  int num_panoramas = 0;
  std::vector<ComparedMethod> methods;
  std::optional<MultiPolygon2> truth;  ///< the true rooms, none without a truth
  std::vector<Eigen::Vector2d> cameras;
  std::string inside_picture;     ///< the panorama that models are seen from inside at
  std::string inside_photo_jpeg;  ///< what it shows there; may be empty
  ComparedLabels labels;
};

/// One HTML page that needs no network and no script: the table of methods, their plans over the
/// truth, their models from two viewpoints, the label maps. Light and dark, for screens of any
/// width. It is well-formed XML. Same input, same bytes.
[[nodiscard]] std::string FormatComparisonPage(const ComparisonPage& page);

}  // namespace enfilade
