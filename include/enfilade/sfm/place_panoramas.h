// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/scene/stand_mask.h"
#include "enfilade/scene/types.h"
#include "enfilade/sfm/features.h"
#include "enfilade/sfm/follow_frames.h"
#include "enfilade/sfm/join_components.h"
#include "enfilade/sfm/metric_scale.h"
#include "enfilade/sfm/register.h"
#include "enfilade/sfm/room_outline.h"

namespace enfilade {

/// What to do with a scene that comes with poses (enfilade/sfm/given_poses.h).
struct GivenPoseOptions {
  bool triangulate = false;
  bool refine = false;
  double max_distance_m = 8;
  double max_error_deg = 1;
  double position_sigma_m = 0.05;
  double rotation_sigma_deg = 0.5;

  void Visit(OptionVisitor& v) {
    v("triangulate", triangulate,
      "Find points with given poses, unless the file brings some: about a second a picture.");
    v("refine", refine, "Refine given poses by bundle adjustment; points are found anew.");
    v("max_distance_m", max_distance_m, "Panoramas further apart than this are not matched.",
      {0.5, 1000.0});
    v("max_error_deg", max_error_deg,
      "Most that a ray may miss its point where poses are not refined.", {0.05, 5.0});
    v("position_sigma_m", position_sigma_m,
      "Expected error of given positions on each axis, for refinement.", {0.001, 10.0});
    v("rotation_sigma_deg", rotation_sigma_deg,
      "Expected error of given rotations about each axis, for refinement.", {0.01, 30.0});
  }
};

struct PlaceOptions {
  FeatureOptions features;
  RegisterOptions registration;
  JoinOptions joining;
  ScaleOptions scale;
  StandOptions stand;
  GivenPoseOptions given;
  bool is_ordered = false;
  FollowOptions follow;

  void Visit(OptionVisitor& v) {
    v("features", features, "Features of the pictures.");
    v("registration", registration, "Poses from features.");
    v("joining", joining, "Components tied by what is seen through doors.");
    v("scale", scale, "Metres.");
    v("stand", stand, "The camera's stand.");
    v("given", given, "Scenes that come with poses.");
    v("ordered", is_ordered,
      "Pictures without poses are the frames of a film in the order of their names: features are "
      "followed through them and keyframes become the views.");
    v("follow", follow, "Ordered pictures.");
  }
};

/// Finds the room about every view of a scene whose poses are good within each component; one
/// outline a view.
using OutlineFinder = std::function<std::vector<RoomOutline>(const Scene&, RunContext&)>;

/// What PlacePanoramas needs besides pictures and options.
struct PlaceSurroundings {
  std::filesystem::path work_folder;  ///< keeps what was seen of the pictures
  std::string program;                ///< a text that changes with the code
  OutlineFinder find_outlines;        ///< empty: components are not joined
};

/// What PlacePanoramas has to say besides the scene.
struct PlaceReport {
  Registration registration;      ///< in camera heights
  std::vector<int> num_features;  ///< one a view
  MetricScale scale;
  std::vector<ComponentJoin> joins;  ///< components by their numbers before they were joined
  /// Of ordered pictures: brightness of each view over that of the first frame; else empty.
  std::vector<double> exposures;
  std::vector<std::string> warnings;  ///< whole sentences, also written to the log
};

/// Poses and points of a scene whose views have none (pose_source kEstimated), from their pictures
/// alone: equirectangular panoramas of one home, in any order.
///
/// Fills world_from_cam, component_idx, storey_idx, points, scale_source and camera_height_m.
/// World: metres, z up, floor at z = 0, walls along x and y where they can be told. What cannot be
/// attached to the largest component, neither by pairs nor through a door (JoinComponents, which
/// needs `find_outlines`; empty: not tried), becomes a further one in the same scale; each
/// component is a storey of its own, since nothing says how it lies to the others, with its
/// cameras' mean at the origin.
///
/// With options.is_ordered the views are frames of a film in the order of their names: features are
/// followed through them (FollowFrames), views that are no keyframes are taken out of the scene,
/// and tracks count as matches beside those of the descriptors.
///
/// Panoramas that stand upside down beside the others are registered so, with a warning. Mirrored
/// ones, copies of one picture and what nothing ties to the rest are named in warnings, as are
/// pictures whose lines contradict the vertical that their metadata tell.
///
/// What was seen of a picture is left in `work_folder`, as files in `features/` or, where COLMAP
/// finds the features, in its database, so that a run that was stopped goes on. Files that are
/// damaged, or came from other options, another mask or another `program` (a text that changes with
/// the code), are made anew. `scene.camera_height_m` and known distances set the scale where given
/// (FindMetricScale). Throws IoError and InvalidInputError for pictures that cannot be read and for
/// known distances that cannot be used, StoppedError. Cost: about two seconds a picture on one
/// core, and matching of the pairs that SelectPairs takes.
[[nodiscard]] PlaceReport PlacePanoramas(const PlaceOptions& options,
                                         const PlaceSurroundings& surroundings, RunContext& context,
                                         Scene& scene);

}  // namespace enfilade
