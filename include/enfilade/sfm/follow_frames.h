// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/scene/stand_mask.h"
#include "enfilade/scene/types.h"
#include "enfilade/sfm/keyframes.h"
#include "enfilade/sfm/klt_tracker.h"
#include "enfilade/sfm/types.h"

namespace enfilade {

/// Tracker for panoramas: features cross the seam, the poles have none.
[[nodiscard]] inline KltOptions PanoramaKltOptions() {
  KltOptions options;
  options.wraps_around = true;
  options.skipped_rows_share = 0.15;
  return options;
}

struct FollowOptions {
  KltOptions tracking = PanoramaKltOptions();
  KeyframeOptions keyframes{.min_parallax_deg = 6.0};

  void Visit(OptionVisitor& v) {
    v("tracking", tracking, "Features from frame to frame.");
    v("keyframes", keyframes, "Frames that are kept.");
  }
};

/// A frame of a film that is kept, and the features that were followed to it.
struct Keyframe {
  int frame_idx = 0;
  double exposure = 1;                ///< brightness over that of the first frame
  std::vector<int> track_ids;         ///< rising
  std::vector<Eigen::Vector3f> rays;  ///< parallel to track_ids, unit, in the camera frame
};

/// The order of a film's frames: by the pictures' names, in which runs of digits count as numbers.
/// Indices into `views`.
[[nodiscard]] std::vector<int> OrderByName(std::span<const View> views);

/// Follows features through panoramas of one size that were taken one after the other (KltTracker)
/// and chooses keyframes (SelectKeyframes), by rising frame_idx. Features that TrustedPixels holds
/// out are left out. One picture is held at a time; cost linear in frames.
///
/// Throws InvalidInputError for frames of several sizes, IoError and InvalidInputError for pictures
/// that cannot be read, StoppedError.
[[nodiscard]] std::vector<Keyframe> FollowFrames(std::span<const View> frames, const Stand& stand,
                                                 const FollowOptions& options, RunContext& context);

/// The matches of all pairs of views that share tracks. `keyframes` and `features` are one a view;
/// each view's features end with the rays of its keyframe.
[[nodiscard]] std::vector<PairMatches> MatchesOfTracks(std::span<const Keyframe> keyframes,
                                                       std::span<const PanoFeatures> features);

}  // namespace enfilade
