// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "enfilade/floorplan/types.h"
#include "enfilade/geometry/triangle_tree.h"
#include "enfilade/model/types.h"

namespace enfilade {

/// A face of the model and how far along a ray it lies.
struct FaceHit {
  int face_idx = 0;
  double distance_m = 0;
};

/// What a ray meets in the model.
struct ModelSight {
  std::optional<FaceHit> face;  ///< the first that shows its front
  std::optional<FaceHit> door;  ///< the first before it that a door pierces, where the door is
};

/// Answers what a camera sees of the model (ray casts). Thread-safe.
///
/// Rays pass through faces in two cases: seen from the front where the plan has a door or opening,
/// and seen from behind within a wall's thickness after the camera or such an opening (a camera in
/// a doorway stands inside the wall). All is in the home frame.
class Visibility {
 public:
  /// Copies what it needs. Throws DependencyError (TriangleTree).
  Visibility(const BuildingModel& model, const Floorplan& plan);

  /// True when nothing stands between the camera and the point on a face.
  [[nodiscard]] bool IsSeen(const Eigen::Vector3d& camera, const Eigen::Vector3d& point) const;

  /// What the camera sees along a unit direction: no face when the ray leaves the model or meets
  /// the back of a wall.
  [[nodiscard]] ModelSight Look(const Eigen::Vector3d& camera,
                                const Eigen::Vector3d& direction) const;

 private:
  // An opening as it pierces one face: a rectangle on the face's plane.
  struct Pierced {
    Eigen::Vector2d origin, along;
    double length_m = 0;
    double sill_z = 0, head_z = 0;
    bool is_door = false;

    [[nodiscard]] bool Holds(const Eigen::Vector3d& p) const;
  };
  struct Face {
    Eigen::Vector3d normal;
    std::vector<Pierced> pierced;
  };
  // Where a ray ends, and whether nothing ended it before the end given.
  struct Walk {
    ModelSight sight;
    bool is_free = false;
  };

  static std::vector<Pierced> PiercedBy(const Storey& storey, const ModelFace& face);
  [[nodiscard]] Walk WalkAlong(const Eigen::Vector3d& camera, const Eigen::Vector3d& direction,
                               double end_m) const;

  std::vector<int> face_of_triangle_;
  std::vector<Face> faces_;
  TriangleTree tree_;
};

}  // namespace enfilade
