// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "enfilade/evidence/types.h"
#include "enfilade/scene/types.h"
#include "enfilade/synthetic/fixtures.h"
#include "enfilade/synthetic/home.h"

namespace enfilade {

/// How poses that were registered from pictures, or placed by hand, differ from the true ones. By
/// default they are about as good as those of an annotated tour.
struct PoseNoise {
  double position_sigma_m = 0.03;  ///< of each coordinate, independent for each camera
  double yaw_sigma_deg = 0.3;      ///< about the vertical, likewise
  double tilt_sigma_deg = 0;       ///< about each of two level axes, likewise
  double drift_m = 0;              ///< of each level coordinate, after one metre of path
  double yaw_drift_deg = 0;        ///< after one metre of path
  double scale_error = 0;          ///< of all lengths, about the first camera
  uint64_t seed = 0;
};

/// FixtureScene with noisy poses. Drift follows the path through home.cameras in their order: every
/// step is the true motion in the frame of the camera before it, with a Gaussian error whose
/// variance grows with the step's length (a random walk), so an error of yaw turns all that
/// follows. The first camera drifts not. Independent errors come on top.
[[nodiscard]] Scene FixturePoses(const Home& home, const PoseNoise& noise = {}, int width = 1024,
                                 int height = 512);

/// FixtureWallSamples as a stage finds them that believes the poses of `believed` (views in the
/// order of home.cameras): profiles are true to their pictures, but stand and turn where the poses
/// say. Tilt is left out: levelling a panorama is that stage's own work.
[[nodiscard]] WallSampleSet FixtureWallSamples(const Home& home, const ProfileNoise& noise,
                                               const Scene& believed);

}  // namespace enfilade
