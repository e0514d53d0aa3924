// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/scene/types.h"

namespace enfilade {

struct ScaleOptions {
  double assumed_height_m = 1.5;
  double assumed_ceiling_m = 2.5;

  void Visit(OptionVisitor& v) {
    v("assumed_height_m", assumed_height_m,
      "Usual height of a camera above the floor, where nothing better is known.", {0.5, 3.0});
    v("assumed_ceiling_m", assumed_ceiling_m,
      "Usual height of rooms, where nothing better is known.", {1.8, 6.0});
  }
};

/// One thing that tells how long a camera height is.
struct ScaleCue {
  std::string name;      ///< "camera height", "ceiling", …
  double metres = 0;     ///< camera height that it says
  double log_sigma = 0;  ///< standard deviation of its logarithm
};

/// The height of the cameras above the floor in metres and where it comes from.
struct MetricScale {
  double camera_height_m = 0;
  double log_sigma = 0;
  ScaleSource source = ScaleSource::kAssumed;
  std::vector<ScaleCue> cues;
  std::vector<std::string> warnings;  ///< cues that disagree, sizes that no home has
};

/// Combines what is known of the scale by weighted least squares of logarithms: a camera height
/// that the user gives (to 1 %), and otherwise the usual camera height (10 %) and the usual height
/// of rooms (12 %) beside `ceilings`, the heights of ceilings in camera heights.
///
/// Warns when the given height makes ceilings lower than 2.2 m or higher than 4 m or is itself
/// outside 1 to 2 m, and when cues disagree by more than three standard deviations.
[[nodiscard]] MetricScale FindMetricScale(std::optional<double> given_height_m,
                                          std::span<const double> ceilings,
                                          const ScaleOptions& options);

}  // namespace enfilade
