// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/synthetic/fixture_poses.h"

#include <cmath>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/structure/wall_samples.h"
#include "src/synthetic/random.h"

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// The believed poses of a walk through the true ones.
std::vector<Rigid3> Walk(const std::vector<Rigid3>& truth, const PoseNoise& noise) {
  std::vector<Rigid3> walked;
  double yaw_rad = 0;  // by which everything is turned so far
  for (size_t i = 0; i < truth.size(); ++i) {
    Rigid3 pose = truth[i];
    if (i > 0) {
      Random random(PartSeed(PartSeed(noise.seed, 0), i));
      const Vector3d step = truth[i].translation - truth[i - 1].translation;
      const double root_m = std::sqrt(step.norm());
      const double x = random.Normal(), y = random.Normal(), turn = random.Normal();
      pose.translation = walked.back().translation + RotationZ(yaw_rad) * step +
                         noise.drift_m * root_m * Vector3d(x, y, 0);
      yaw_rad += DegToRad(noise.yaw_drift_deg) * root_m * turn;
      pose.rotation = RotationZ(yaw_rad) * pose.rotation;
    }
    walked.push_back(pose);
  }
  return walked;
}

void AddIndependentNoise(const PoseNoise& noise, size_t camera_idx, Rigid3& world_from_cam) {
  Random random(PartSeed(PartSeed(noise.seed, 1), camera_idx));
  const double x = random.Normal(), y = random.Normal(), z = random.Normal();
  world_from_cam.translation += noise.position_sigma_m * Vector3d(x, y, z);
  const double yaw_rad = DegToRad(noise.yaw_sigma_deg) * random.Normal();
  const double tilt_x = random.Normal(), tilt_y = random.Normal();
  const Vector3d tilt_rad = DegToRad(noise.tilt_sigma_deg) * Vector3d(tilt_x, tilt_y, 0);
  if (tilt_rad.norm() > 0) {
    world_from_cam.rotation =
        Eigen::AngleAxisd(tilt_rad.norm(), tilt_rad.normalized()) * world_from_cam.rotation;
  }
  world_from_cam.rotation = RotationZ(yaw_rad) * world_from_cam.rotation;
}

}  // namespace

Scene FixturePoses(const Home& home, const PoseNoise& noise, int width, int height) {
  ENFILADE_CHECK(noise.scale_error > -1);
  Scene scene = FixtureScene(home, width, height);
  std::vector<Rigid3> truth;
  for (const View& view : scene.views) truth.push_back(view.world_from_cam);
  const std::vector<Rigid3> walked = Walk(truth, noise);
  for (size_t i = 0; i < walked.size(); ++i) {
    Rigid3& pose = scene.views[i].world_from_cam;
    pose = walked[i];
    AddIndependentNoise(noise, i, pose);
    pose.translation += noise.scale_error * (pose.translation - walked[0].translation);
  }
  return scene;
}

WallSampleSet FixtureWallSamples(const Home& home, const ProfileNoise& noise,
                                 const Scene& believed) {
  ENFILADE_CHECK(believed.views.size() == home.cameras.size());
  WallSampleSet set = MakeWallSamples(FixtureStructure(home, noise), believed, 0);
  for (WallSample& sample : set.samples) {
    const auto i = static_cast<size_t>(sample.view_idx);
    const Matrix3d believed_from_true = believed.views[i].world_from_cam.rotation *
                                        home.WorldFromCamera(sample.view_idx).rotation.transpose();
    const double yaw_rad = std::atan2(believed_from_true(1, 0) - believed_from_true(0, 1),
                                      believed_from_true(0, 0) + believed_from_true(1, 1));
    sample.direction = Eigen::Rotation2Dd(yaw_rad) * sample.direction;
  }
  return set;
}

}  // namespace enfilade
