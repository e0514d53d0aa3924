// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/bundle_adjustment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <span>
#include <vector>

#include "enfilade/geometry/angles.h"
#include "enfilade/sfm/gravity.h"
#include "tests/sfm/pose_errors.h"
#include "tests/sfm/registration_scene.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

// Six cameras in a room, everything as it is in truth.
class MadeBundle {
 public:
  explicit MadeBundle(const MadeSceneOptions& scene_options = {}) {
    scene = MakeRegistrationScene(scene_options, SpreadCameras(0.2, 3, 2.6, 6, 1));
    poses = scene.world_from_cam;
    tracks = TrueTracks(scene);
    planes.ceilings = {scene_options.ceiling};
  }
  double Adjust(const BundleOptions& options = {}) {
    return AdjustBundle(scene.features, scene.gravity, options, poses, tracks, planes);
  }
  // Cameras move by up to `move` on each axis and turn by up to `turn_rad` on each.
  void Disturb(double move, double turn_rad, uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto any = [&]() { return Vector3d(uniform(random), uniform(random), uniform(random)); };
    for (Rigid3& pose : poses) {
      const Vector3d turn = turn_rad * any();
      pose.translation += move * any();
      pose.rotation = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * pose.rotation;
    }
    for (Track& track : tracks) track.position += move * any();
  }
  [[nodiscard]] PoseErrors Errors() const { return ComparePoses(poses, scene.world_from_cam); }

  RegistrationScene scene;
  std::vector<Rigid3> poses;
  std::vector<Track> tracks;
  LevelPlanes planes;
};

double LargestPointError(const MadeBundle& bundle) {
  const std::vector<Track> truth = TrueTracks(bundle.scene);
  double largest = 0;
  for (size_t i = 0; i < truth.size(); ++i) {
    largest = std::max(largest, (bundle.tracks[i].position - truth[i].position).norm());
  }
  return largest;
}

// Rays are floats: 1e-7.
TEST(AdjustBundle, APerfectSceneStays) {
  MadeBundle bundle;
  EXPECT_LT(bundle.Adjust(), 1e-6);
  EXPECT_LT(bundle.Errors().position, 1e-6);
  EXPECT_LT(bundle.Errors().rotation_rad, 1e-6);
  EXPECT_LT(LargestPointError(bundle), 1e-4);
  EXPECT_NEAR(bundle.planes.ceilings[0], 1.7, 1e-6);
}

TEST(AdjustBundle, BringsDisturbedPosesBack) {
  for (uint32_t seed = 1; seed <= 3; ++seed) {
    MadeBundle bundle;
    bundle.Disturb(0.03, DegToRad(1), seed);
    EXPECT_LT(bundle.Adjust(), 1e-5);
    EXPECT_LT(bundle.Errors().position, 1e-4) << "seed " << seed;
    EXPECT_LT(bundle.Errors().rotation_rad, 1e-4) << "seed " << seed;
  }
}

TEST(AdjustBundle, KeepsPlaceAndYawOfTheFirstCamera) {
  MadeBundle bundle;
  bundle.Disturb(0.02, DegToRad(0.5), 4);
  const Rigid3 before = bundle.poses[0];
  bundle.Adjust();
  EXPECT_LT((bundle.poses[0].translation - before.translation).head<2>().norm(), 1e-4);
  // Turned upright, x of the camera still has its azimuth.
  const Vector3d x_before = before.rotation.col(0), x_after = bundle.poses[0].rotation.col(0);
  EXPECT_NEAR(std::atan2(x_after.y(), x_after.x()), std::atan2(x_before.y(), x_before.x()), 1e-4);
}

// Each ray has two errors of sigma, and 3 unknowns a point, 6 a camera take their share of them:
// rms = sigma · sqrt(2 − (3 points + 6 cameras) / rays). Planes and loss change that by some per
// cent. A camera sees some 280 points about 1.5 away, so it errs by 1.5 · 0.05° / √280 ≈ 1e-4 on
// an axis; what the cameras share (scale) is not much worse.
TEST(AdjustBundle, NoiseGivesTheErrorsItShould) {
  for (uint32_t seed = 1; seed <= 3; ++seed) {
    const double sigma_rad = DegToRad(0.05);
    MadeBundle bundle({.noise_rad = sigma_rad, .seed = seed});
    bundle.Disturb(0.02, DegToRad(0.5), seed);
    const double rms_rad = bundle.Adjust();
    double num_rays = 0;
    for (const Track& track : bundle.tracks) {
      num_rays += static_cast<double>(track.observations.size());
    }
    const double unknowns = 3.0 * static_cast<double>(bundle.tracks.size()) + 6 * 6;
    const double expected_rad = sigma_rad * std::sqrt(2 - unknowns / num_rays);
    EXPECT_NEAR(rms_rad, expected_rad, 0.1 * expected_rad);
    EXPECT_LT(bundle.Errors().position, 1e-3) << "seed " << seed;
    EXPECT_LT(RadToDeg(bundle.Errors().rotation_rad), 0.03) << "seed " << seed;
    EXPECT_NEAR(bundle.planes.ceilings[0], 1.7, 1e-3);
  }
}

// One sight in twenty points 3° to 10° past its point.
TEST(AdjustBundle, StandsFalseSights) {
  MadeBundle bundle({.noise_rad = DegToRad(0.05)});
  std::mt19937 random(1);
  for (PanoFeatures& view : bundle.scene.features) {
    for (Eigen::Vector3f& ray : view.rays) {
      if (random() % 20 != 0) continue;
      const float off = 0.05F + 0.12F * static_cast<float>(random() % 100) / 100;
      ray = (ray + off * ray.unitOrthogonal()).normalized();
    }
  }
  bundle.Disturb(0.01, DegToRad(0.3), 1);
  bundle.Adjust();
  EXPECT_LT(bundle.Errors().position, 3e-3);
  EXPECT_LT(RadToDeg(bundle.Errors().rotation_rad), 0.1);
}

// All verticals say that the scene leans by 1°. Rays do not mind, heights hardly.
TEST(AdjustBundle, FollowsTheVerticals) {
  for (const Vector3d& axis : {Vector3d(1, 0, 0), Vector3d(0, 1, 0)}) {
    MadeBundle bundle;
    const Vector3d up = Eigen::AngleAxisd(DegToRad(1), axis) * Vector3d(0, 0, 1);
    for (size_t i = 0; i < bundle.poses.size(); ++i) {
      bundle.scene.gravity[i].up_in_cam = bundle.poses[i].rotation.transpose() * up;
    }
    bundle.planes = {-5, {}};
    bundle.Adjust({.camera_height_sigma = 1});
    for (size_t i = 0; i < bundle.poses.size(); ++i) {
      const Vector3d in_world = bundle.poses[i].rotation * bundle.scene.gravity[i].up_in_cam;
      EXPECT_LT(RadToDeg(AngleBetween(in_world, Vector3d::UnitZ())), 0.01);
    }
  }
}

// The scene shrunk by 3 % towards the plane of the cameras: rays and heights still fit, the floor
// alone tells.
double ScaleAfter(bool has_floor) {
  MadeBundle bundle;
  const double shrink = 0.97;
  const auto shrunk = [&](const Vector3d& x) {
    return Vector3d(shrink * x.x(), shrink * x.y(), 1 + shrink * (x.z() - 1));
  };
  for (Rigid3& pose : bundle.poses) pose.translation = shrunk(pose.translation);
  for (Track& track : bundle.tracks) track.position = shrunk(track.position);
  bundle.planes.ceilings.clear();
  if (!has_floor) bundle.planes.floor = -5;
  bundle.Adjust();
  return (bundle.poses[5].translation - bundle.poses[0].translation).norm() /
         (bundle.scene.world_from_cam[5].translation - bundle.scene.world_from_cam[0].translation)
             .norm();
}

// Two cameras share four points; the walls of the second seem to run a degree off. How much that
// turns it depends on how good the rays are.
TEST(AdjustBundle, FollowsTheWallsWhereRaysAreWeak) {
  const auto turn_of_second = [](double ray_sigma_deg) {
    MadeBundle bundle;
    bundle.poses.resize(2);
    std::erase_if(bundle.tracks, [](Track& track) {
      std::erase_if(track.observations, [](const Observation& seen) { return seen.view_idx > 1; });
      return track.observations.size() < 2;
    });
    bundle.tracks.resize(4);
    bundle.scene.gravity.resize(2);
    bundle.scene.world_from_cam.resize(2);
    for (size_t i = 0; i < 2; ++i) {
      const Eigen::Matrix3d world_from_level = bundle.scene.world_from_cam[i].rotation *
                                               LevelFromCam(bundle.scene.gravity[i]).transpose();
      bundle.scene.gravity[i].heading_rad =
          DegToRad(20) - std::atan2(world_from_level(1, 0), world_from_level(0, 0)) +
          static_cast<double>(i) * (kPi / 2 - DegToRad(1));
    }
    bundle.Adjust({.ray_sigma_deg = ray_sigma_deg});
    return TurnBetween(bundle.poses[1].rotation, bundle.scene.world_from_cam[1].rotation);
  };
  EXPECT_GT(turn_of_second(5), DegToRad(0.5));
  EXPECT_LT(turn_of_second(0.005), DegToRad(0.05));
}

TEST(AdjustBundle, PointsOnTheFloorFixTheScale) {
  EXPECT_NEAR(ScaleAfter(true), 1, 1e-4);
  EXPECT_NEAR(ScaleAfter(false), 0.97, 1e-3);
}

TEST(AdjustBundle, RefinesCeilings) {
  MadeBundle bundle;
  bundle.planes.ceilings = {1.73, 2.4};  // nothing lies on the second
  bundle.Adjust();
  EXPECT_NEAR(bundle.planes.ceilings[0], 1.7, 1e-4);
  EXPECT_NEAR(bundle.planes.ceilings[1], 2.4, 1e-4);
  EXPECT_EQ(bundle.planes.floor, 0);
}

// A rough floor under six cameras: its points would lie nearer to their plane if all were smaller.
TEST(AdjustBundle, ErrorsOfManyPointsDoNotShrinkTheScene) {
  MadeBundle bundle({.num_points_per_room = 4000});
  std::mt19937 random(1);
  std::normal_distribution<float> bump(0, 0.006F);
  for (Track& track : bundle.tracks) {
    if (std::abs(track.position.z()) > 1e-6) continue;
    track.position.z() = bump(random);
    for (const Observation& seen : track.observations) {
      const Rigid3& pose = bundle.poses[static_cast<size_t>(seen.view_idx)];
      bundle.scene.features[static_cast<size_t>(seen.view_idx)]
          .rays[static_cast<size_t>(seen.feature_idx)] =
          (pose.rotation.transpose() * (track.position - pose.translation))
              .normalized()
              .cast<float>();
    }
  }
  bundle.Adjust();
  const auto apart = [](std::span<const Rigid3> poses) {
    return (poses.front().translation - poses.back().translation).norm();
  };
  EXPECT_NEAR(apart(bundle.poses) / apart(bundle.scene.world_from_cam), 1, 5e-4);
}

TEST(AdjustBundle, LeavesViewsWithoutObservations) {
  MadeBundle bundle({.noise_rad = DegToRad(0.05)});
  for (const int unseen : {0, 4}) {
    for (Track& track : bundle.tracks) {
      std::erase_if(track.observations,
                    [&](const Observation& sight) { return sight.view_idx == unseen; });
    }
  }
  bundle.Disturb(0.01, DegToRad(0.3), 2);
  const std::vector<Rigid3> before = bundle.poses;
  bundle.Adjust();
  for (const size_t unseen : {0u, 4u}) {
    EXPECT_EQ(bundle.poses[unseen].rotation, before[unseen].rotation);
    EXPECT_EQ(bundle.poses[unseen].translation, before[unseen].translation);
  }
  const PoseErrors errors =
      ComparePoses(bundle.poses, bundle.scene.world_from_cam, std::vector<int>{1, 2, 3, 5});
  EXPECT_LT(errors.position, 1e-3);
}

TEST(AdjustBundle, NothingToAdjust) {
  MadeBundle bundle;
  bundle.tracks.clear();
  EXPECT_EQ(bundle.Adjust(), 0);
  for (size_t i = 0; i < bundle.poses.size(); ++i) {
    EXPECT_EQ(bundle.poses[i].rotation, bundle.scene.world_from_cam[i].rotation);
  }
  std::vector<Rigid3> no_poses;
  std::vector<Track> no_tracks;
  LevelPlanes planes;
  EXPECT_EQ(AdjustBundle({}, {}, {}, no_poses, no_tracks, planes), 0);
}

TEST(AdjustBundle, TheSameBytesTwice) {
  MadeBundle first({.noise_rad = DegToRad(0.05)});
  first.Disturb(0.02, DegToRad(0.5), 3);
  MadeBundle second = first;
  EXPECT_EQ(first.Adjust(), second.Adjust());
  for (size_t i = 0; i < first.poses.size(); ++i) {
    EXPECT_EQ(std::memcmp(&first.poses[i], &second.poses[i], sizeof(Rigid3)), 0);
  }
  for (size_t i = 0; i < first.tracks.size(); ++i) {
    EXPECT_EQ(first.tracks[i].position, second.tracks[i].position);
  }
}

TEST(AdjustGivenPoses, BringsDisturbedPosesBackInTheFrameOfThoseGiven) {
  for (uint32_t seed = 1; seed <= 3; ++seed) {
    MadeBundle bundle;
    bundle.Disturb(0.03, DegToRad(0.5), seed);
    const std::vector<Rigid3> given = bundle.poses;
    EXPECT_LT(AdjustGivenPoses(bundle.scene.features, given, bundle.scene.gravity,
                               {0.05, DegToRad(0.5)}, {}, bundle.poses, bundle.tracks),
              1e-3);
    Vector3d before = Vector3d::Zero(), after = Vector3d::Zero();
    double scatter_before = 0, scatter_after = 0;
    for (size_t i = 0; i < given.size(); ++i) {
      before += given[i].translation / static_cast<double>(given.size());
      after += bundle.poses[i].translation / static_cast<double>(given.size());
    }
    const std::vector<Rigid3>& truth = bundle.scene.world_from_cam;
    for (size_t i = 1; i < given.size(); ++i) {
      const Vector3d apart = truth[i].translation - truth[0].translation;
      scatter_before += (given[i].translation - given[0].translation - apart).norm();
      scatter_after += (bundle.poses[i].translation - bundle.poses[0].translation - apart).norm();
    }
    EXPECT_LT((after - before).norm(), 0.005) << "seed " << seed;
    EXPECT_LT(scatter_after, 0.5 * scatter_before) << "seed " << seed;
  }
}

}  // namespace
}  // namespace enfilade
