// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "enfilade/scene/types.h"
#include "enfilade/synthetic/home.h"

namespace enfilade {

/// How the points of multi-view stereo differ from the surfaces that they were found on. With the
/// default values a home without furniture gets about the accuracy that PMVS2 reached on a real
/// one: 41 % of the points within 5 cm of a true plane and 58 % within 10 cm.
struct PointNoise {
  double spacing_m = 0.05;      ///< one place is tried for every square of this side
  double half_contrast = 0.02;  ///< contrast of the picture at which half of the places are found
  double match_probability = 0.8;  ///< that a camera which sees a place recognises it
  int min_views = 2;
  double min_angle_deg = 10;     ///< between two of a point's views
  double max_range_m = 10;       ///< of cameras from the place
  double match_sigma_deg = 3.4;  ///< error between two cameras: of the match and of their poses
  double ray_sigma_deg = 0.1;    ///< error of the direction in which the nearest camera sees it
  double normal_sigma_deg = 8;   ///< of a normal about each of two axes
  double outlier_share = 0.24;   ///< points that lie anywhere along the ray
  double clump_share = 0.12;     ///< points that float in clumps before the surface
  double clump_radius_m = 0.1;   ///< standard deviation of a clump about its centre
  int points_per_clump = 40;
  double hole_share = 0.15;  ///< share of the surface in round holes without points
  double hole_radius_m = 0.4;
  uint64_t seed = 0;
};

/// The points that multi-view stereo finds on a home's surfaces: walls, floors, ceilings, trim and
/// furniture, in world, without pictures. `view_idx` counts home.cameras, ascending; the normal
/// looks at the nearest of them; the colour is the surface's own under white light.
///
/// Places are drawn evenly over the surfaces. One is found where its surroundings have contrast (a
/// window of 2° in the nearest camera, edges included) and at least min_views cameras that see it
/// recognise it, two of them at min_angle_deg or more. A place in a mirror is what the mirror
/// shows, behind it.
///
/// Noise: along the ray of the nearest camera Gaussian with the standard deviation
/// match_sigma · d² / b, d the distance and b the largest baseline across the ray, cut at d / 2;
/// across the ray ray_sigma · d. An outlier lies anywhere between 0.3 m and twice the
/// distance along that ray; the centre of a clump anywhere between the camera and a surface.
///
/// The home and the noise determine every byte. Cost: about ten rays per place and camera.
[[nodiscard]] std::vector<ScenePoint> FixturePoints(const Home& home, const PointNoise& noise = {});

}  // namespace enfilade
