// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/geometry/rigid3.h"
#include "enfilade/sfm/tracks.h"
#include "enfilade/sfm/types.h"

namespace enfilade {

struct BundleOptions {
  double ray_sigma_deg = 0.06;
  double camera_height_sigma = 0.01;
  double plane_sigma = 0.01;
  double wall_sigma_deg = 0.3;
  int max_iterations = 50;

  void Visit(OptionVisitor& v) {
    v("ray_sigma_deg", ray_sigma_deg, "Expected error of a feature's direction.", {0.001, 2.0});
    v("camera_height_sigma", camera_height_sigma,
      "Expected scatter of the cameras' heights above the floor, as a share of their height.",
      {0.0001, 1.0});
    v("plane_sigma", plane_sigma,
      "Expected scatter of points on floor and ceiling, as a share of the cameras' height.",
      {0.0001, 1.0});
    v("wall_sigma_deg", wall_sigma_deg,
      "Expected error of the walls' direction that one panorama tells.", {0.01, 90.0});
    v("max_iterations", max_iterations, "Bound on the solver's iterations.", {1.0, 1000.0});
  }
};

/// Level planes that points are drawn to.
struct LevelPlanes {
  double floor = 0;              ///< height of the floor, fixed
  std::vector<double> ceilings;  ///< heights of ceilings, refined
};

/// Refines cameras and points together: minimises the angles between observed rays and the
/// directions to the points (Cauchy's loss), with priors on the verticals (`gravity`, one a view),
/// on the cameras' height above the floor (1, with Cauchy's loss: homes are photographed from a
/// tripod), on the walls' direction in each panorama (one heading modulo 90° for all that are
/// within 1.5° of it) and on points that lie within a few standard deviations of the floor or of a
/// ceiling. Units are camera heights. The first view that has observations keeps its place and yaw.
///
/// Positions and rotations of views without observations stay as they are. Runs in one thread in a
/// fixed order, so that the same input gives the same bytes. Returns the root mean square error of
/// the rays in radians. (Triggs et al., Bundle Adjustment – A Modern Synthesis, 1999.)
double AdjustBundle(std::span<const PanoFeatures> features, std::span<const Gravity> gravity,
                    const BundleOptions& options, std::vector<Rigid3>& world_from_cam,
                    std::vector<Track>& tracks, LevelPlanes& planes);

/// Expected errors of given poses, on each axis.
struct GivenPoseSigmas {
  double position_m = 0.05;
  double rotation_rad = 0.01;
};

/// As AdjustBundle, in metres, with other priors: every camera is drawn to its `given` pose
/// (Cauchy's loss, so that one that is far off has little say), and its vertical to the z axis, or
/// to the direction that most verticals have in the given world where that is another by more than
/// the rotations' errors explain. Nothing else holds the frame, which so stays that of the given
/// poses. Of the options only the rays' error and the iterations count.
double AdjustGivenPoses(std::span<const PanoFeatures> features, std::span<const Rigid3> given,
                        std::span<const Gravity> gravity, const GivenPoseSigmas& sigmas,
                        const BundleOptions& options, std::vector<Rigid3>& world_from_cam,
                        std::vector<Track>& tracks);

}  // namespace enfilade
