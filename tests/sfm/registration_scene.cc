// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/sfm/registration_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include "enfilade/geometry/angles.h"
#include "enfilade/sfm/gravity.h"
#include "tests/sfm/random_descriptors.h"

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDoorWidth = 0.6, kDoorHeight = 1.4;
// Points of walls keep away from floor and ceiling, so that they cannot be taken for theirs.
constexpr double kSkirting = 0.08;
constexpr double kHalfThickness = 0.03;  // of partitions, so that each side has its own points

class Dice {
 public:
  explicit Dice(uint32_t seed) : random_(seed) {}
  double Between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double Normal(double sigma) { return sigma * std::normal_distribution<double>()(random_); }
  Vector3d Direction() {
    const Vector3d direction(Normal(1), Normal(1), Normal(1));
    return direction.normalized();
  }
  std::mt19937& engine() { return random_; }

 private:
  std::mt19937 random_;
};

Vector3d OnWall(double x0, double x1, const MadeSceneOptions& options, Dice& dice) {
  const double along = dice.Between(0, 1), z = dice.Between(kSkirting, options.ceiling - kSkirting);
  switch (static_cast<int>(dice.Between(0, 4))) {
    case 0:
      return {x0, along * options.depth, z};
    case 1:
      return {x1, along * options.depth, z};
    case 2:
      return {x0 + along * (x1 - x0), 0, z};
    default:
      return {x0 + along * (x1 - x0), options.depth, z};
  }
}

std::vector<Vector3d> MakePoints(const MadeSceneOptions& options, Dice& dice) {
  constexpr std::array<double, 3> kFurniture = {0.3, 0.5, 0.6};  // seats, tables, worktops
  std::vector<Vector3d> points;
  for (size_t room = 0; room + 1 < options.wall_x.size(); ++room) {
    const double x0 = options.wall_x[room] + kHalfThickness;
    const double x1 = options.wall_x[room + 1] - kHalfThickness;
    for (int i = 0; i < options.num_points_per_room; ++i) {
      const Vector2d at(dice.Between(x0, x1), dice.Between(0, options.depth));
      const std::array<Vector3d, 4> choice = {
          Vector3d(at.x(), at.y(), 0), Vector3d(at.x(), at.y(), options.ceiling),
          OnWall(x0, x1, options, dice),
          Vector3d(at.x(), at.y(), kFurniture[static_cast<size_t>(i / 4 % 3)])};
      points.push_back(choice[static_cast<size_t>(i % 4)]);
    }
  }
  return points;
}

bool IsInSight(const Vector3d& eye, const Vector3d& point, const MadeSceneOptions& options) {
  for (size_t p = 0; p + 2 < options.wall_x.size(); ++p) {
    const double x = options.wall_x[p + 1];
    if ((eye.x() - x) * (point.x() - x) >= 0) continue;
    const Vector3d crossing = eye + (x - eye.x()) / (point.x() - eye.x()) * (point - eye);
    const bool is_in_door =
        std::abs(crossing.y() - options.depth / 2) < kDoorWidth / 2 && crossing.z() < kDoorHeight;
    if (!options.is_door_open[p] || !is_in_door) return false;
  }
  return (point - eye).norm() > 0.1;
}

Rigid3 PoseOf(const MadeCamera& camera) {
  Matrix3d upright;
  upright << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  const double angle = camera.tilt_rad.norm();
  const Vector3d axis(camera.tilt_rad.x(), camera.tilt_rad.y(), 0);
  const Matrix3d tilt =
      angle > 0 ? Eigen::AngleAxisd(angle, axis / angle).toRotationMatrix() : Matrix3d::Identity();
  return {RotationZ(camera.yaw_rad) * tilt * upright,
          {camera.at.x(), camera.at.y(), camera.height}};
}

// A direction off by `sigma_rad` on each axis across it.
Vector3d Jittered(const Vector3d& direction, double sigma_rad, Dice& dice) {
  const Vector3d noise(dice.Normal(sigma_rad), dice.Normal(sigma_rad), dice.Normal(sigma_rad));
  return (direction + noise - noise.dot(direction) * direction).normalized();
}

struct SeenFeature {
  float size_rad;
  int point_idx;  // −1: false or lone
  Vector3d ray;
  std::array<uint8_t, kDescriptorSize> values;
};

SeenFeature Describe(int point_idx, const Vector3d& ray, const uint8_t* values, Dice& dice) {
  constexpr double kValueNoise = 3;
  SeenFeature feature{static_cast<float>(dice.Between(0.005, 0.05)), point_idx, ray, {}};
  for (size_t k = 0; k < kDescriptorSize; ++k) {
    const double value = values[k] + dice.Between(-kValueNoise, kValueNoise);
    feature.values[k] = static_cast<uint8_t>(std::clamp<double>(value, 0, kMaxDescriptorValue));
  }
  return feature;
}

std::vector<SeenFeature> Look(const RegistrationScene& scene, const Rigid3& pose,
                              const DescriptorSet& descriptors, const MadeSceneOptions& options,
                              Dice& dice) {
  std::vector<SeenFeature> seen;
  for (size_t i = 0; i < scene.points.size(); ++i) {
    if (!IsInSight(pose.translation, scene.points[i], options)) continue;
    if (dice.Between(0, 1) >= options.seen_share) continue;
    const bool is_false = dice.Between(0, 1) < options.false_share;
    const Vector3d to_point = (pose.Inverse() * scene.points[i]).normalized();
    const Vector3d ray = is_false ? dice.Direction() : Jittered(to_point, options.noise_rad, dice);
    seen.push_back(Describe(is_false ? -1 : static_cast<int>(i), ray,
                            descriptors.row(static_cast<int>(i)), dice));
    // Of a size in the world, 3 to 9 cm.
    const double size = 0.03 + 0.06 * std::fmod(0.618 * static_cast<double>(i), 1.0);
    seen.back().size_rad = static_cast<float>(size / (pose.Inverse() * scene.points[i]).norm());
  }
  const int num_lone =
      static_cast<int>(std::lround(options.lone_share * static_cast<double>(seen.size())));
  const DescriptorSet lone =
      RandomValues(num_lone, kMaxDescriptorValue, static_cast<uint32_t>(dice.engine()()));
  for (int i = 0; i < num_lone; ++i) {
    seen.push_back(Describe(-1, dice.Direction(), lone.row(i), dice));
  }
  std::stable_sort(seen.begin(), seen.end(), [](const SeenFeature& x, const SeenFeature& y) {
    return x.size_rad > y.size_rad;
  });
  return seen;
}

}  // namespace

RegistrationScene MakeRegistrationScene(const MadeSceneOptions& options,
                                        std::span<const MadeCamera> cameras) {
  RegistrationScene scene;
  Dice dice(options.seed);
  scene.points = MakePoints(options, dice);
  const DescriptorSet descriptors =
      RandomValues(static_cast<int>(scene.points.size()), kMaxDescriptorValue, options.seed + 1000);
  for (const MadeCamera& camera : cameras) {
    const Rigid3 pose = PoseOf(camera);
    scene.world_from_cam.push_back(pose);
    PanoFeatures features;
    std::vector<int> point_of_feature;
    for (const SeenFeature& seen : Look(scene, pose, descriptors, options, dice)) {
      features.rays.push_back(seen.ray.cast<float>());
      features.sizes_rad.push_back(seen.size_rad);
      features.descriptors.values.insert(features.descriptors.values.end(), seen.values.begin(),
                                         seen.values.end());
      point_of_feature.push_back(seen.point_idx);
    }
    scene.features.push_back(std::move(features));
    scene.point_of_feature.push_back(std::move(point_of_feature));
    const Vector3d up = pose.rotation.transpose() * Vector3d::UnitZ();
    scene.gravity.push_back({Jittered(up, options.gravity_noise_rad, dice),
                             std::max(DegToRad(0.1), options.gravity_noise_rad),
                             20,
                             {}});
  }
  return scene;
}

std::vector<MadeCamera> SpreadCameras(double x0, double x1, double depth, int count,
                                      uint32_t seed) {
  Dice dice(seed);
  std::vector<MadeCamera> cameras;
  const int num_columns = (count + 1) / 2;
  for (int i = 0; i < count; ++i) {
    const double x = x0 + (x1 - x0) * (i / 2 + 0.5) / num_columns + dice.Between(-0.1, 0.1);
    const double y = depth * (i % 2 == 0 ? 0.3 : 0.65) + dice.Between(-0.1, 0.1);
    cameras.push_back({{x, y}, dice.Between(-kPi, kPi), 1, {0, 0}});
  }
  return cameras;
}

RegistrationScene MakeRowOfRooms(MadeSceneOptions options, int num_rooms, int cameras_per_room,
                                 bool are_doors_open) {
  constexpr double kRoomWidth = 3.2, kClear = 0.2;
  options.wall_x = {0};
  std::vector<MadeCamera> cameras;
  for (int room = 0; room < num_rooms; ++room) {
    const double x0 = room * kRoomWidth, x1 = x0 + kRoomWidth;
    options.wall_x.push_back(x1);
    options.is_door_open.push_back(are_doors_open);
    const std::vector<MadeCamera> own = SpreadCameras(
        x0 + kClear, x1 - kClear, options.depth, cameras_per_room, static_cast<uint32_t>(room));
    cameras.insert(cameras.end(), own.begin(), own.end());
  }
  return MakeRegistrationScene(options, cameras);
}

std::vector<Vector3d> LevelRaysOf(const RegistrationScene& scene, int view_idx) {
  const Matrix3d level_from_cam = LevelFromCam(scene.gravity[static_cast<size_t>(view_idx)]);
  std::vector<Vector3d> rays;
  for (const Eigen::Vector3f& ray : scene.features[static_cast<size_t>(view_idx)].rays) {
    rays.emplace_back((level_from_cam * ray.cast<double>()).normalized());
  }
  return rays;
}

std::vector<FeatureMatch> TrueMatches(const RegistrationScene& scene, int a_idx, int b_idx) {
  std::map<int, int> b_of_point;
  const std::vector<int>& of_b = scene.point_of_feature[static_cast<size_t>(b_idx)];
  for (size_t i = 0; i < of_b.size(); ++i) {
    if (of_b[i] >= 0) b_of_point[of_b[i]] = static_cast<int>(i);
  }
  std::vector<FeatureMatch> matches;
  const std::vector<int>& of_a = scene.point_of_feature[static_cast<size_t>(a_idx)];
  for (size_t i = 0; i < of_a.size(); ++i) {
    const auto match = b_of_point.find(of_a[i]);
    if (match != b_of_point.end()) matches.push_back({static_cast<int>(i), match->second, 0.1F});
  }
  return matches;
}

PanoPair TruePair(const RegistrationScene& scene, int a_idx, int b_idx) {
  const Rigid3& a = scene.world_from_cam[static_cast<size_t>(a_idx)];
  const Rigid3& b = scene.world_from_cam[static_cast<size_t>(b_idx)];
  // The level frame in the world: what is left of the rotation once the tilt is taken off.
  const Matrix3d world_from_a =
      a.rotation * LevelFromCam(scene.gravity[static_cast<size_t>(a_idx)]).transpose();
  const Matrix3d world_from_b =
      b.rotation * LevelFromCam(scene.gravity[static_cast<size_t>(b_idx)]).transpose();
  PanoPair pair;
  pair.a_idx = a_idx;
  pair.b_idx = b_idx;
  pair.verdict = PairVerdict::kAccepted;
  pair.inliers = TrueMatches(scene, a_idx, b_idx);
  pair.num_matches = static_cast<int>(pair.inliers.size());
  pair.a_from_b = world_from_a.transpose() * world_from_b;
  const Vector3d baseline = world_from_a.transpose() * (b.translation - a.translation);
  pair.direction = baseline.normalized();
  pair.length = baseline.norm();
  pair.length_sigma = 0.03;
  return pair;
}

std::vector<Track> TrueTracks(const RegistrationScene& scene) {
  std::vector<Track> of_point(scene.points.size());
  for (int view = 0; view < scene.num_views(); ++view) {
    const std::vector<int>& points = scene.point_of_feature[static_cast<size_t>(view)];
    for (size_t i = 0; i < points.size(); ++i) {
      if (points[i] < 0) continue;
      Track& track = of_point[static_cast<size_t>(points[i])];
      track.observations.push_back({view, static_cast<int>(i)});
      track.position = scene.points[static_cast<size_t>(points[i])];
    }
  }
  std::erase_if(of_point, [](const Track& track) { return track.observations.size() < 2; });
  return of_point;
}

}  // namespace enfilade
