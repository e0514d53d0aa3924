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
  std::string known_distance;
  double assumed_height_m = 1.5;
  double assumed_ceiling_m = 2.5;
  double assumed_door_m = 2.0;

  void Visit(OptionVisitor& v) {
    v("known_distance", known_distance,
      "Measured distance between two cameras, as PICTURE,PICTURE,METRES; more of them after "
      "semicolons.");
    v("assumed_height_m", assumed_height_m,
      "Usual height of a camera above the floor, where nothing better is known.", {0.5, 3.0});
    v("assumed_ceiling_m", assumed_ceiling_m,
      "Usual height of rooms, where nothing better is known.", {1.8, 6.0});
    v("assumed_door_m", assumed_door_m,
      "Usual height of door heads above the floor, where nothing better is known.", {1.5, 3.0});
  }
};

/// A distance between two cameras that the user has measured.
struct KnownDistance {
  int a_idx = 0, b_idx = 0;  ///< views
  double metres = 0;
};

/// Reads ScaleOptions::known_distance. Pictures are named as the views are, with or without the
/// extension. Throws InvalidInputError for anything else than two different pictures of `views` and
/// a length above 0.
[[nodiscard]] std::vector<KnownDistance> ParseKnownDistances(const std::string& text,
                                                             std::span<const View> views);

/// A distance that is known both in metres and in the registration's unit.
struct MeasuredDistance {
  std::string name;  ///< "a.jpg – b.jpg"
  double metres = 0;
  double camera_heights = 0;
};

/// The known distances between registered cameras, `positions` in camera heights, one a view.
/// Throws InvalidInputError, naming the pictures, for two that are in different components or that
/// registration puts closer together than a tenth of a camera height.
[[nodiscard]] std::vector<MeasuredDistance> MeasureDistances(
    std::span<const KnownDistance> known, std::span<const View> views,
    std::span<const Eigen::Vector3d> positions, std::span<const int> component_idx);

/// What is known of the scale. Lengths without unit are in camera heights.
struct ScaleEvidence {
  std::optional<double> given_height_m{};  ///< by the user
  std::vector<MeasuredDistance> distances{};
  std::optional<double> door_head{};  ///< height of door heads above the floor
  std::vector<double> ceilings{};     ///< heights of level planes above the cameras
};

/// One thing that tells how long a camera height is.
struct ScaleCue {
  std::string name;          ///< "given camera height", "door heads", …
  double metres = 0;         ///< camera height that it says
  double log_sigma = 0;      ///< standard deviation of its logarithm
  bool is_measured = false;  ///< by the user; what is usual otherwise
  double weight = 0;         ///< its share in the result; all sum to 1
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
/// that the user gives (to 1 %) and known distances (to 0.5 %, and 0.02 camera heights for the
/// cameras' places). What is usual counts only where nothing is measured: door heads (2.5 %: doors
/// differ by 2 %, and on 20 made homes and a real one the edges were found to 1.5 %), the camera's
/// height (10 %) and the height of rooms (12 %).
///
/// Warns when ceilings come out lower than 2.2 m or higher than 4 m or cameras outside 1 to 2 m,
/// and of every cue that is more than three standard deviations off the result, counted or not.
[[nodiscard]] MetricScale FindMetricScale(const ScaleEvidence& evidence,
                                          const ScaleOptions& options);

/// A cue in words: "door heads: cameras stand at 1.49 m ± 2.5 %, weight 88 %".
[[nodiscard]] std::string DescribeCue(const ScaleCue& cue);

}  // namespace enfilade
