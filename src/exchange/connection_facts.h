// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "enfilade/exchange/connection_report.h"

namespace enfilade {

/// A view as reports show it.
struct ViewFact {
  std::string picture;  ///< printable
  std::string name;     ///< short, see ShortNames
  int component = 0;    ///< into ConnectionFacts::components
  bool is_inferred = false;
  int num_features = 0;
  int num_points = 0;  ///< of the scene, seen by it
  int num_ties = 0;    ///< pairs that tie it to another view
  Eigen::Vector3d position_m{0, 0, 0};
  double yaw_rad = 0;   ///< azimuth of the picture's centre
  double tilt_rad = 0;  ///< between the camera's upward axis and the world's
};

/// A pair as reports show it.
struct PairFact {
  int a = 0, b = 0;  ///< views
  PairVerdict verdict = PairVerdict::kFewMatches;
  bool is_tie = false;     ///< ties its views together
  bool is_within = false;  ///< both views are of one component, so that the scene places them
  int num_matches = 0;
  int num_inliers = 0;
  double parallax_rad = 0;
  double log10_chance = 0;
  std::optional<double> distance_m;          ///< between the cameras, within one component
  std::optional<double> yaw_miss_rad;        ///< of the pair against the scene, in [−π, π)
  std::optional<double> direction_miss_rad;  ///< of the level baseline, in [0, π]
};

/// Views that pairs tie together.
struct ComponentFact {
  int idx = 0;                     ///< as the scene numbers it
  std::vector<int> views;          ///< ascending
  Eigen::Vector2d extent_m{0, 0};  ///< of the cameras along the world's x and y
};

struct PointFact {
  Eigen::Vector2d position_m{0, 0};
  int component = 0;
};

/// All that the report tells.
struct ConnectionFacts {
  std::string title;
  std::vector<ViewFact> views;            ///< in the order of the scene
  std::vector<PairFact> pairs;            ///< ascending in a, then b
  std::vector<ComponentFact> components;  ///< ascending in idx
  std::vector<PointFact> points;          ///< from above
  std::vector<std::string> warnings;      ///< printable
  int num_left_out = 0;                   ///< pairs with fewer than kMinReportedMatches
  int64_t num_not_matched = 0;            ///< pairs of views that the report does not tell of
};

/// Pairs with fewer matches are reported only when they tie their views.
inline constexpr int kMinReportedMatches = 8;

/// Requires what FormatConnectionsSvg requires.
[[nodiscard]] ConnectionFacts CollectConnectionFacts(const Scene& scene,
                                                     const ConnectionReport& report);

/// The pair contradicts what other pairs agree on.
[[nodiscard]] inline bool IsContradiction(const PairFact& pair) {
  return pair.verdict == PairVerdict::kAgainstTriplets ||
         pair.verdict == PairVerdict::kAgainstPositions;
}

/// "1 picture", "2 pictures"; `things` where the plural is not made with s.
[[nodiscard]] std::string Counted(size_t count, const std::string& thing,
                                  const std::string& things = {});

}  // namespace enfilade
