// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/given_poses.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "enfilade/base/median.h"
#include "enfilade/geometry/angles.h"
#include "src/sfm/match_pairs.h"
#include "src/sfm/seen_pictures.h"

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// A pair that tells another rotation or direction than the poses is false, or a pose is.
constexpr double kMaxTurn_rad = DegToRad(5), kMaxDirection_rad = DegToRad(10);
// Expected error of a baseline's ends when the file is good: short baselines may point anywhere.
constexpr double kMaxShift_m = 0.3;

// Pairs less likely by chance than this count where they tell the same as the poses.
constexpr double kWeakLog10Chance = -4, kSureLog10Chance = -20;

std::vector<Rigid3> PosesOf(const Scene& scene) {
  std::vector<Rigid3> poses;
  for (const View& view : scene.views) poses.push_back(view.world_from_cam);
  return poses;
}

// The verticals that the poses tell.
std::vector<Gravity> GravityOf(std::span<const Rigid3> poses) {
  std::vector<Gravity> gravity(poses.size());
  for (size_t i = 0; i < poses.size(); ++i) {
    gravity[i].up_in_cam = poses[i].rotation.transpose() * Vector3d::UnitZ();
  }
  return gravity;
}

Matrix3d WorldFromLevel(const Rigid3& pose, const Gravity& gravity) {
  return pose.rotation * LevelFromCam(gravity).transpose();
}

std::vector<PairToMatch> ListNearPairs(const Scene& scene, std::span<const Gravity> gravity,
                                       double max_distance_m) {
  std::vector<PairToMatch> pairs;
  const auto yaw = [&](size_t i) {
    return YawOf(WorldFromLevel(scene.views[i].world_from_cam, gravity[i]));
  };
  for (size_t a = 0; a < scene.views.size(); ++a) {
    for (size_t b = a + 1; b < scene.views.size(); ++b) {
      const View &view_a = scene.views[a], &view_b = scene.views[b];
      const double apart_m =
          (view_a.world_from_cam.translation - view_b.world_from_cam.translation).norm();
      const bool is_near = view_a.storey_idx == view_b.storey_idx && apart_m <= max_distance_m;
      if (!is_near || !IsPanorama(view_a) || !IsPanorama(view_b)) continue;
      pairs.push_back({.a_idx = static_cast<int>(a),
                       .b_idx = static_cast<int>(b),
                       .yaw_rad = WrapPi(yaw(b) - yaw(a)),
                       .followed = {}});
    }
  }
  return pairs;
}

// Whether a pair tells about the same as the given poses.
bool AgreesWithPoses(const PanoPair& pair, std::span<const Rigid3> poses,
                     std::span<const Gravity> gravity) {
  const size_t a = static_cast<size_t>(pair.a_idx), b = static_cast<size_t>(pair.b_idx);
  const Matrix3d world_from_a = WorldFromLevel(poses[a], gravity[a]);
  const Matrix3d a_from_b = world_from_a.transpose() * WorldFromLevel(poses[b], gravity[b]);
  if (std::abs(WrapPi(pair.Yaw_rad() - YawOf(a_from_b))) > kMaxTurn_rad) return false;
  const Vector3d baseline = poses[b].translation - poses[a].translation;
  const Vector3d told = baseline.norm() * (world_from_a * pair.direction);
  const double miss_m = (told - baseline).norm();
  // What is not sure by itself may be so far off by chance.
  const bool is_sure = pair.log10_chance <= kSureLog10Chance;
  return miss_m <= std::max(kMaxShift_m, is_sure ? kMaxDirection_rad * baseline.norm() : 0);
}

// Refuses accepted pairs that contradict the poses, and takes those that are too weak to stand
// alone but tell the same.
std::vector<std::string> JudgeByPoses(std::span<const Rigid3> poses,
                                      std::span<const Gravity> gravity,
                                      std::vector<PanoPair>& pairs) {
  int num_accepted = 0, num_contrary = 0;
  for (PanoPair& pair : pairs) {
    const bool is_accepted = pair.verdict == PairVerdict::kAccepted;
    const bool is_weak =
        pair.verdict == PairVerdict::kChance && pair.log10_chance <= kWeakLog10Chance;
    if (!is_accepted && !is_weak) continue;
    const bool agrees = AgreesWithPoses(pair, poses, gravity);
    num_accepted += is_accepted ? 1 : 0;
    num_contrary += is_accepted && !agrees ? 1 : 0;
    if (agrees) pair.verdict = PairVerdict::kAccepted;
    if (is_accepted && !agrees) pair.verdict = PairVerdict::kAgainstPositions;
  }
  if (3 * num_contrary <= num_accepted) return {};
  return {fmt::format(
      "{} of {} pairs of pictures contradict the given poses: check that they belong together",
      num_contrary, num_accepted)};
}

std::vector<Track> RefinePoses(const std::vector<Track>& chains, const SeenPictures& seen,
                               const PlaceOptions& options, RunContext& context,
                               std::vector<Rigid3>& poses, double& ray_error_rad) {
  constexpr std::array<double, 4> kMaxErrors_deg = {2.0, 1.0, 0.5, 0.3};
  constexpr double kRaySigmaShare = 0.2;
  const std::vector<Rigid3> given = poses;
  const GivenPoseSigmas sigmas{.position_m = options.given.position_sigma_m,
                               .rotation_rad = DegToRad(options.given.rotation_sigma_deg)};
  std::vector<Track> tracks;
  for (const double max_error_deg : kMaxErrors_deg) {
    context.CheckStop();
    tracks =
        TriangulateTracks(poses, seen.features, {.max_error_rad = DegToRad(max_error_deg)}, chains);
    // Rays miss by what the given poses are wrong: a narrow loss would take all of them for false.
    BundleOptions bundle = options.registration.bundle;
    bundle.ray_sigma_deg = std::max(bundle.ray_sigma_deg, kRaySigmaShare * max_error_deg);
    ray_error_rad =
        AdjustGivenPoses(seen.features, given, seen.gravity, sigmas, bundle, poses, tracks);
  }
  return TriangulateTracks(poses, seen.features, {.max_error_rad = DegToRad(kMaxErrors_deg.back())},
                           chains);
}

// Takes refined poses into the scene and notes how far they moved.
void TakePoses(std::span<const Rigid3> poses, Scene& scene, GivenPoseReport& report) {
  std::vector<double> shifts_m, turns_rad;
  for (size_t i = 0; i < poses.size(); ++i) {
    Rigid3& pose = scene.views[i].world_from_cam;
    if (IsPanorama(scene.views[i])) {
      shifts_m.push_back((poses[i].translation - pose.translation).norm());
      turns_rad.push_back(Eigen::AngleAxisd(pose.rotation.transpose() * poses[i].rotation).angle());
    }
    pose = poses[i];
  }
  report.median_shift_m = UpperMedian(shifts_m);
  report.median_turn_rad = UpperMedian(turns_rad);
}

}  // namespace

bool IsWorkOnGivenPoses(const GivenPoseOptions& options, const Scene& scene) {
  if (scene.pose_source == PoseSource::kEstimated) return false;
  return options.refine || (options.triangulate && scene.points.empty());
}

GivenPoseReport FindPointsOfPoses(const PlaceOptions& options,
                                  const std::filesystem::path& work_folder,
                                  const std::string& program, RunContext& context, Scene& scene) {
  std::vector<Rigid3> poses = PosesOf(scene);
  SeenPictures seen =
      LookAtPictures(scene, {}, options.features, options.stand, work_folder, program, context);
  std::vector<Gravity> gravity = GravityOf(poses);
  for (size_t i = 0; i < gravity.size(); ++i) gravity[i].heading_rad = seen.gravity[i].heading_rad;
  GivenPoseReport report;
  for (const PanoFeatures& features : seen.features) report.num_features.push_back(features.size());
  report.pairs = MatchPairs(ListNearPairs(scene, gravity, options.given.max_distance_m),
                            seen.features, gravity, TurnLevel(seen.features, gravity),
                            options.registration.match, options.registration.two_view, context);
  FindMissingColours(scene, context, seen);
  report.warnings = JudgeByPoses(poses, gravity, report.pairs);
  std::vector<Track> tracks = BuildTracks(report.pairs, seen.features);
  if (options.given.refine) {
    tracks = RefinePoses(tracks, seen, options, context, poses, report.ray_error_rad);
    TakePoses(poses, scene, report);
    context.log().Info(
        fmt::format("refined poses: moved by {:.3f} m, turned by {:.2f} deg (median)",
                    report.median_shift_m, RadToDeg(report.median_turn_rad)));
  } else {
    tracks = TriangulateTracks(poses, seen.features,
                               {.max_error_rad = DegToRad(options.given.max_error_deg)},
                               std::move(tracks));
  }
  scene.points.clear();
  for (const Track& track : tracks) scene.points.push_back(PointOfTrack(track, seen, scene.views));
  for (const std::string& warning : report.warnings) context.log().Warning(warning);
  return report;
}

}  // namespace enfilade
