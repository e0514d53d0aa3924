// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/place_panoramas.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "enfilade/base/check.h"
#include "src/sfm/component_heading.h"
#include "src/sfm/door_heads.h"
#include "src/sfm/floor_matches.h"
#include "src/sfm/level_rays.h"
#include "src/sfm/odd_pictures.h"
#include "src/sfm/picture_warnings.h"
#include "src/sfm/seen_pictures.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

// Follows the scene's pictures as the frames of a film and leaves the keyframes in the scene; one
// keyframe a view.
std::vector<Keyframe> KeepKeyframes(const PlaceOptions& options, RunContext& context,
                                    Scene& scene) {
  const std::vector<int> order = OrderByName(scene.views);
  std::vector<View> frames;
  for (const int view : order) frames.push_back(scene.views[static_cast<size_t>(view)]);
  const Stand stand = FindStandOfScene(scene, options.stand, context);
  std::map<int, Keyframe> of_view;
  for (Keyframe& keyframe : FollowFrames(frames, stand, options.follow, context)) {
    of_view[order[static_cast<size_t>(keyframe.frame_idx)]] = std::move(keyframe);
  }
  std::vector<View> kept;
  std::vector<Keyframe> keyframes;
  for (auto& [view, keyframe] : of_view) {
    kept.push_back(scene.views[static_cast<size_t>(view)]);
    keyframes.push_back(std::move(keyframe));
  }
  context.log().Info(fmt::format("{} of {} frames are keyframes", kept.size(), frames.size()));
  scene.views = std::move(kept);
  return keyframes;
}

// Turns and moves each component so that its walls run along x and y and its cameras' mean is the
// origin. Returns world_from_component.
std::vector<Rigid3> AlignComponents(const SeenPictures& seen, const Registration& registration) {
  const int num_components =
      1 + *std::max_element(registration.component_idx.begin(), registration.component_idx.end());
  std::vector<Rigid3> world_from_component;
  for (int component = 0; component < num_components; ++component) {
    std::vector<LevelLine> lines;
    Vector3d sum = Vector3d::Zero();
    double count = 0;
    for (size_t i = 0; i < seen.features.size(); ++i) {
      if (registration.component_idx[i] != component) continue;
      const Rigid3& pose = registration.world_from_cam[i];
      const std::vector<LevelLine> own = LevelLines(seen.segments[i], pose.rotation);
      lines.insert(lines.end(), own.begin(), own.end());
      sum += Vector3d(pose.translation.x(), pose.translation.y(), 0);
      count += 1;
    }
    const Eigen::Matrix3d rotation = RotationZ(-FindHeading(lines).value_or(0));
    world_from_component.push_back({rotation, -(rotation * (sum / count))});
  }
  return world_from_component;
}

// Numbers components from the largest on again; of equal ones, that with the first view comes
// first.
void Renumber(std::vector<int>& component_idx) {
  struct Component {
    int size = 0, first = 0, idx = 0;
  };
  std::vector<Component> components(component_idx.size());
  for (size_t i = component_idx.size(); i-- > 0;) {
    Component& component = components[static_cast<size_t>(component_idx[i])];
    component = {component.size + 1, static_cast<int>(i), component_idx[i]};
  }
  std::sort(components.begin(), components.end(), [](const Component& x, const Component& y) {
    return x.size != y.size ? x.size > y.size : x.first < y.first;
  });
  std::vector<int> number(component_idx.size(), 0);
  for (size_t k = 0; k < components.size() && components[k].size > 0; ++k) {
    number[static_cast<size_t>(components[k].idx)] = static_cast<int>(k);
  }
  for (int& component : component_idx) component = number[static_cast<size_t>(component)];
}

// Makes one component of each two that a join ties, and pairs of what is seen through its door.
// Joins are in metres, between components as `world_from_component` places them.
void ApplyJoins(std::span<const ComponentJoin> joins, std::span<const Rigid3> world_from_component,
                double camera_height_m, std::span<const Gravity> gravity,
                Registration& registration) {
  std::vector<PanoPair*> tied;
  // The group of each component and its place there, in camera heights.
  std::vector<int> group;
  for (size_t c = 0; c < world_from_component.size(); ++c) group.push_back(static_cast<int>(c));
  std::vector<Rigid3> group_from_component(world_from_component.begin(),
                                           world_from_component.end());
  for (const ComponentJoin& join : joins) {
    const size_t a = static_cast<size_t>(join.a), b = static_cast<size_t>(join.b);
    Rigid3 a_from_b = join.a_from_b;
    a_from_b.translation /= camera_height_m;
    const Rigid3 a_group_from_b_group = group_from_component[a] *
                                        world_from_component[a].Inverse() * a_from_b *
                                        world_from_component[b] * group_from_component[b].Inverse();
    const int group_b = group[b];
    for (size_t c = 0; c < group.size(); ++c) {
      if (group[c] != group_b) continue;
      group[c] = group[a];
      group_from_component[c] = a_group_from_b_group * group_from_component[c];
    }
    for (const DoorPair& found : join.pairs) {
      const auto pair = std::find_if(
          registration.pairs.begin(), registration.pairs.end(), [&](const PanoPair& candidate) {
            return candidate.a_idx == found.a_idx && candidate.b_idx == found.b_idx;
          });
      if (pair == registration.pairs.end()) continue;
      pair->verdict = PairVerdict::kAccepted;
      pair->inliers = found.inliers;
      pair->log10_chance = -join.log_odds / std::log(10.0);
      tied.push_back(&*pair);
    }
  }
  for (size_t i = 0; i < registration.component_idx.size(); ++i) {
    const size_t component = static_cast<size_t>(registration.component_idx[i]);
    registration.world_from_cam[i] =
        group_from_component[component] * registration.world_from_cam[i];
    registration.component_idx[i] = group[component];
  }
  for (PanoPair* pair : tied) {
    const size_t a = static_cast<size_t>(pair->a_idx), b = static_cast<size_t>(pair->b_idx);
    SetGeometry(registration.world_from_cam[a], registration.world_from_cam[b], gravity[a],
                gravity[b], *pair);
  }
  Renumber(registration.component_idx);
}

void SetPoses(const Registration& registration, std::span<const Rigid3> world_from_component,
              double camera_height_m, Scene& scene) {
  for (size_t i = 0; i < scene.views.size(); ++i) {
    View& view = scene.views[i];
    view.component_idx = registration.component_idx[i];
    view.storey_idx = view.component_idx;
    view.world_from_cam = world_from_component[static_cast<size_t>(view.component_idx)] *
                          registration.world_from_cam[i];
    view.world_from_cam.translation *= camera_height_m;
  }
}

void SetPoints(const SeenPictures& seen, const Registration& registration,
               std::span<const Rigid3> world_from_component, double camera_height_m, Scene& scene) {
  scene.points.clear();
  for (const Track& track : registration.tracks) {
    const int component =
        registration.component_idx[static_cast<size_t>(track.observations.front().view_idx)];
    ScenePoint point = PointOfTrack(track, seen, scene.views);
    point.position =
        camera_height_m * (world_from_component[static_cast<size_t>(component)] * track.position);
    scene.points.push_back(std::move(point));
  }
}

// The places that floors tell; their spots are added to the features.
std::vector<FloorMatch> MatchSeenFloors(const RegisterOptions& options, RunContext& context,
                                        SeenPictures& seen) {
  const std::vector<ViewPair> pairs =
      SelectPairs(seen.features, options.selection, options.match, context);
  return MatchFloors(seen.floors, pairs, seen.gravity, context, seen.features);
}

// Refines poses with what floors show where panoramas are known to stand; a film's tracks do
// without.
void RefineOnFloors(const PlaceOptions& options, RunContext& context, SeenPictures& seen,
                    Registration& registration) {
  if (options.is_ordered) return;
  if (MatchFloorsAgain(seen.floors, seen.gravity, context, registration, seen.features) == 0) {
    return;
  }
  RegisterOptions refinement = options.registration;
  refinement.use_guided = false;
  RefineRegistration(seen.features, seen.gravity, refinement, context, registration);
}

// Registers the panoramas, those that stand upside down beside the others turned over.
Registration Register(const Scene& scene, const PlaceOptions& options, RunContext& context,
                      std::span<const PairMatches> followed, SeenPictures& seen,
                      std::vector<std::string>& warnings) {
  std::vector<FloorMatch> floors;
  if (!options.is_ordered) floors = MatchSeenFloors(options.registration, context, seen);
  Registration registration = RegisterFeatures(seen.features, seen.gravity, options.registration,
                                               context, followed, floors);
  const std::vector<Gravity> gravity_before = seen.gravity;
  const std::vector<OddTie> upside_down = TurnOverTheUpsideDown(
      registration.component_idx, options.registration, context, seen.features, seen.gravity);
  if (!upside_down.empty()) {
    // What was taken for the floor of a picture on its head is the ceiling.
    const auto is_turned = [&](int view) {
      const size_t i = static_cast<size_t>(view);
      return seen.gravity[i].up_in_cam != gravity_before[i].up_in_cam;
    };
    for (size_t i = 0; i < seen.floors.size(); ++i) {
      if (is_turned(static_cast<int>(i))) seen.floors[i] = {};
    }
    std::erase_if(floors, [&](const FloorMatch& floor) {
      return is_turned(floor.a_idx) || is_turned(floor.b_idx);
    });
    registration = RegisterFeatures(seen.features, seen.gravity, options.registration, context,
                                    followed, floors);
  }
  RefineOnFloors(options, context, seen, registration);
  WarnOfUpsideDown(scene.views, upside_down, warnings);
  WarnOfMirrored(scene.views,
                 FindMirrored(seen.features, seen.gravity, registration.component_idx,
                              options.registration, context),
                 warnings);
  WarnOfCopies(scene.views, FindCopies(seen.features, seen.gravity, registration.pairs), warnings);
  return registration;
}

std::optional<double> DoorHead(const SeenPictures& seen, const ScaleOptions& options) {
  std::vector<std::vector<UprightEdge>> edges;
  for (size_t i = 0; i < seen.segments.size(); ++i) {
    edges.push_back(UprightEdges(seen.segments[i], LevelFromCam(seen.gravity[i])));
  }
  return FindDoorHead(edges, options.assumed_door_m / options.assumed_height_m);
}

MetricScale FindScale(std::optional<double> given_height_m, std::span<const View> views,
                      std::span<const KnownDistance> known, const SeenPictures& seen,
                      const Registration& registration, const ScaleOptions& options) {
  std::vector<Vector3d> positions;
  for (const Rigid3& pose : registration.world_from_cam) positions.push_back(pose.translation);
  return FindMetricScale(
      {.given_height_m = given_height_m,
       .distances = MeasureDistances(known, views, positions, registration.component_idx),
       .door_head = DoorHead(seen, options),
       .ceilings = registration.ceilings},
      options);
}

}  // namespace

PlaceReport PlacePanoramas(const PlaceOptions& options, const PlaceSurroundings& surroundings,
                           RunContext& context, Scene& scene) {
  ENFILADE_CHECK(!scene.views.empty());
  const std::vector<KnownDistance> known =
      ParseKnownDistances(options.scale.known_distance, scene.views);
  std::vector<Keyframe> keyframes;
  if (options.is_ordered) keyframes = KeepKeyframes(options, context, scene);
  SeenPictures seen = LookAtPictures(scene, keyframes, options.features, options.stand,
                                     surroundings.work_folder, surroundings.program, context);
  std::vector<PairMatches> followed;
  if (options.is_ordered) followed = MatchesOfTracks(keyframes, seen.features);
  PlaceReport report;
  WarnOfToldVerticals(scene.views, seen.gravity, report.warnings);
  for (const Keyframe& keyframe : keyframes) report.exposures.push_back(keyframe.exposure);
  for (const PanoFeatures& features : seen.features) report.num_features.push_back(features.size());
  Registration& registration = report.registration;
  registration = Register(scene, options, context, followed, seen, report.warnings);
  const std::optional<double> given_height_m = scene.camera_height_m;
  std::vector<Rigid3> world_from_component;
  const auto place = [&](std::span<const KnownDistance> distances) {
    report.scale =
        FindScale(given_height_m, scene.views, distances, seen, registration, options.scale);
    world_from_component = AlignComponents(seen, registration);
    scene.scale_source = report.scale.source;
    scene.camera_height_m = report.scale.camera_height_m;
    SetPoses(registration, world_from_component, report.scale.camera_height_m, scene);
  };
  const int num_components =
      1 + *std::max_element(registration.component_idx.begin(), registration.component_idx.end());
  if (num_components > 1 && surroundings.find_outlines) {
    // A known distance may be one between components.
    place({});
    const std::vector<RoomOutline> outlines = surroundings.find_outlines(scene, context);
    std::vector<Rigid3> world_from_cam;
    for (const View& view : scene.views) world_from_cam.push_back(view.world_from_cam);
    report.joins =
        JoinComponents({world_from_cam, registration.component_idx, seen.features, seen.gravity,
                        outlines, registration.pairs, report.scale.camera_height_m},
                       options.joining, context);
    if (!report.joins.empty()) {
      ApplyJoins(report.joins, world_from_component, report.scale.camera_height_m, seen.gravity,
                 registration);
      RefineRegistration(seen.features, seen.gravity, options.registration, context, registration);
      RefineOnFloors(options, context, seen, registration);
    }
  }
  place(known);
  for (const ScaleCue& cue : report.scale.cues) context.log().Info(DescribeCue(cue));
  WarnOfUntied(scene.views, registration.component_idx, report.warnings);
  report.warnings.insert(report.warnings.end(), report.scale.warnings.begin(),
                         report.scale.warnings.end());
  FindMissingColours(scene, context, seen);
  SetPoints(seen, registration, world_from_component, report.scale.camera_height_m, scene);
  for (const std::string& warning : report.warnings) context.log().Warning(warning);
  return report;
}

}  // namespace enfilade
