// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "enfilade/geometry/rigid3.h"
#include "enfilade/sfm/types.h"

namespace enfilade {

/// One sight of a track: a feature of a view.
struct Observation {
  int view_idx = 0;
  int feature_idx = 0;
};

/// A point of the scene and the features that show it, in the order of their views, at most one a
/// view.
struct Track {
  std::vector<Observation> observations;
  Eigen::Vector3d position{0, 0, 0};  ///< in world
};

/// Chains of agreeing matches of the connecting pairs (Moulon and Monasse, CVMP 2012), in the order
/// of their first feature. A chain with two different features of one view is false somewhere and
/// left out; two that look in one direction are one feature with two orientations.
[[nodiscard]] std::vector<Track> BuildTracks(std::span<const PanoPair> pairs,
                                             std::span<const PanoFeatures> features);

struct TriangulationBounds {
  double max_error_rad = 0.01;   ///< between a ray and the direction to the point
  double min_angle_rad = 0.026;  ///< largest angle between two rays, at least
};

/// The point that a track shows, from cameras `world_from_cam`: the hypothesis of two rays with
/// which most observations agree, refined over them. Observations that do not agree are removed.
/// None, and the track is left as it is, when fewer than two agree or their rays meet at too small
/// an angle.
[[nodiscard]] bool TriangulateTrack(std::span<const Rigid3> world_from_cam,
                                    std::span<const PanoFeatures> features,
                                    const TriangulationBounds& bounds, Track& track);

/// The tracks that TriangulateTrack accepts, with their points.
[[nodiscard]] std::vector<Track> TriangulateTracks(std::span<const Rigid3> world_from_cam,
                                                   std::span<const PanoFeatures> features,
                                                   const TriangulationBounds& bounds,
                                                   std::vector<Track> tracks);

}  // namespace enfilade
