// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/scene/stand_mask.h"
#include "enfilade/scene/types.h"
#include "enfilade/sfm/features.h"
#include "enfilade/sfm/follow_frames.h"
#include "enfilade/sfm/gravity.h"
#include "enfilade/sfm/tracks.h"
#include "src/sfm/floor_picture.h"

namespace enfilade {

/// What is kept of the pictures of a scene, one of each a view.
struct SeenPictures {
  std::vector<PanoFeatures> features;
  std::vector<std::vector<Eigen::Matrix<uint8_t, 3, 1>>> colours;  ///< of the first features
  std::vector<Gravity> gravity;
  std::vector<std::vector<LineSegment>> segments;
  std::vector<FloorPicture> floors;
};

/// Finds features, lines and floors of a scene's panoramas, in parallel; at most one picture a
/// thread is held. `keyframes` is empty or one a view: what was followed becomes the last features
/// of the view, without descriptors. Of pinhole views nothing is found. `work_folder` keeps what
/// was seen (seen_picture.h) or, where COLMAP finds the features, its database; `program` is a text
/// that changes with the code. Throws IoError and InvalidInputError for pictures that cannot be
/// read.
[[nodiscard]] SeenPictures LookAtPictures(const Scene& scene, std::span<const Keyframe> keyframes,
                                          const FeatureOptions& features, const StandOptions& stand,
                                          const std::filesystem::path& work_folder,
                                          const std::string& program, RunContext& context);

/// Gives colours to all features of the panoramas that have some without: reads their pictures
/// again, in parallel. Throws like LookAtPictures.
void FindMissingColours(const Scene& scene, RunContext& context, SeenPictures& seen);

/// The scene's point of a track, at the track's position, with the pixels and the colour that its
/// views show.
[[nodiscard]] ScenePoint PointOfTrack(const Track& track, const SeenPictures& seen,
                                      std::span<const View> views);

}  // namespace enfilade
