// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>

#include "enfilade/floorplan/types.h"
#include "enfilade/model/types.h"

namespace enfilade {

/// Answers whether a camera sees a point on a face of the model (Embree ray casts). Thread-safe.
class Visibility {
 public:
  /// Copies what it needs.
  Visibility(const BuildingModel& model, const Floorplan& plan);
  ~Visibility();
  Visibility(const Visibility&) = delete;
  Visibility& operator=(const Visibility&) = delete;

  /// True when nothing stands between the camera and the point (both in the home frame). Faces are
  /// passed through in two cases: seen from the front where the plan has a door or opening, and
  /// seen from behind within a wall's thickness after the camera or such an opening (a camera in a
  /// doorway stands inside the wall).
  [[nodiscard]] bool IsSeen(const Eigen::Vector3d& camera, const Eigen::Vector3d& point) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace enfilade
