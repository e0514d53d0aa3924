// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "src/sfm/door_matches.h"

namespace enfilade {

/// Components of which the smaller shares more of its floor lie on each other: rooms do not.
inline constexpr double kMaxOverlap = 0.25;

/// The floor that the panoramas of one component see before their walls.
class ComponentFloor {
 public:
  explicit ComponentFloor(std::vector<RoomView> views);

  [[nodiscard]] const std::vector<RoomView>& views() const { return views_; }
  /// True before the walls of any panorama moved outward by `margin_m`.
  [[nodiscard]] bool Contains(const Eigen::Vector2d& point, double margin_m) const;
  /// Share of the smaller floor that both have in common when the other is placed so; walls that
  /// lie 10 cm too far out do no harm.
  [[nodiscard]] double OverlapShare(const ComponentFloor& other,
                                    const Rigid3& this_from_other) const;

  /// Area of this floor, widened by `margin_m`, that another one covers when it is placed so.
  [[nodiscard]] double SharedArea_m2(const ComponentFloor& other, const Rigid3& this_from_other,
                                     double margin_m) const;

 private:
  [[nodiscard]] double Area_m2() const;

  std::vector<RoomView> views_;
  std::vector<Eigen::Vector2d> cells_;  // centres
};

}  // namespace enfilade
