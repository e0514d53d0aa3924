// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/scene/types.h"
#include "enfilade/sfm/place_panoramas.h"
#include "enfilade/sfm/types.h"

namespace enfilade {

/// True when the options ask for points or refined poses and the scene, whose poses are given,
/// lacks them: a model that brings points keeps them unless poses are refined.
[[nodiscard]] bool IsWorkOnGivenPoses(const GivenPoseOptions& options, const Scene& scene);

/// What FindPointsOfPoses has to say besides the scene.
struct GivenPoseReport {
  std::vector<PanoPair> pairs;        ///< all that were matched, with what became of them
  std::vector<int> num_features;      ///< one a view
  double ray_error_rad = 0;           ///< root mean square over the points
  double median_shift_m = 0;          ///< by how much refinement moved the cameras
  double median_turn_rad = 0;         ///< and turned them
  std::vector<std::string> warnings;  ///< whole sentences, also written to the log
};

/// Points of a scene whose poses are given, from features of its panoramas, and on request better
/// poses. Pinhole views are left as they are and see no points.
///
/// Matched are panoramas of one storey no further than max_distance_m from each other. A pair
/// counts when what its features tell (EstimatePair) agrees with the given poses within a few
/// degrees, however weak it is; a strong one that does not is kAgainstPositions, and many of these
/// are reported. Points are the
/// nearest to the rays of a chain of matches (TriangulateTrack) within max_error_deg.
///
/// With `refine`, four rounds of triangulation and bundle adjustment (AdjustGivenPoses) with bounds
/// of 2°, 1°, 0.5° and 0.3° follow, in which every camera is drawn to its given pose; so the world
/// stays that of the file. Storeys, components and the source of scale do not change.
///
/// Replaces scene.points. Same input, same bytes for any number of threads. Throws IoError and
/// InvalidInputError for pictures that cannot be read, StoppedError. Cost: about two seconds a
/// picture on one core, and the number of pairs for matching.
[[nodiscard]] GivenPoseReport FindPointsOfPoses(const PlaceOptions& options,
                                                const std::filesystem::path& work_folder,
                                                const std::string& program, RunContext& context,
                                                Scene& scene);

}  // namespace enfilade
