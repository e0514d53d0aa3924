// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/bundle_adjustment.h"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "enfilade/base/median.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/sfm/gravity.h"

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Points this many standard deviations from a level plane may belong to it.
constexpr double kPlaneReach = 5;
constexpr double kFixedSigma = 1e-5;
// Cameras this many standard deviations from the common height count half.
constexpr double kHeightReach = 2.0;
// Walls within this of the common heading are drawn to it: others may stand aslant.
constexpr double kSameHeading_rad = DegToRad(1.5);

// A camera while it is refined: rotation vector of world_from_cam, position.
using CameraBlock = std::array<double, 6>;

CameraBlock ToBlock(const Rigid3& pose) {
  CameraBlock block{};
  ceres::RotationMatrixToAngleAxis(pose.rotation.data(), block.data());
  for (int k = 0; k < 3; ++k) block[static_cast<size_t>(3 + k)] = pose.translation[k];
  return block;
}

Rigid3 ToPose(const CameraBlock& block) {
  Rigid3 pose;
  ceres::AngleAxisToRotationMatrix(block.data(), pose.rotation.data());
  pose.translation = Vector3d(block[3], block[4], block[5]);
  return pose;
}

// Angle between the observed ray and the direction to the point, on two axes across the ray.
struct RayResidual {
  RayResidual(const Vector3d& ray_in_cam, double sigma_rad) {
    Vector3d helper = Vector3d::UnitX();
    if (std::abs(ray_in_cam.x()) > 0.7) helper = Vector3d::UnitY();
    const Vector3d u = ray_in_cam.cross(helper).normalized();
    across.row(0) = u.transpose() / sigma_rad;
    across.row(1) = ray_in_cam.cross(u).transpose() / sigma_rad;
  }
  template <typename T>
  bool operator()(const T* camera, const T* point, T* residual) const {
    const T offset[3] = {point[0] - camera[3], point[1] - camera[4], point[2] - camera[5]};
    const T inverse[3] = {-camera[0], -camera[1], -camera[2]};
    T in_cam[3];
    ceres::AngleAxisRotatePoint(inverse, offset, in_cam);
    const T norm = sqrt(in_cam[0] * in_cam[0] + in_cam[1] * in_cam[1] + in_cam[2] * in_cam[2]);
    for (int r = 0; r < 2; ++r) {
      residual[r] =
          (across(r, 0) * in_cam[0] + across(r, 1) * in_cam[1] + across(r, 2) * in_cam[2]) / norm;
    }
    return true;
  }
  Eigen::Matrix<double, 2, 3> across;
};

// How far the camera's vertical leans from the world's, which leans by `lean` from its z axis.
struct VerticalResidual {
  Vector3d up_in_cam;
  double sigma_rad;
  Eigen::Vector2d lean;
  template <typename T>
  bool operator()(const T* camera, T* residual) const {
    const T up[3] = {T(up_in_cam.x()), T(up_in_cam.y()), T(up_in_cam.z())};
    T up_in_world[3];
    ceres::AngleAxisRotatePoint(camera, up, up_in_world);
    residual[0] = (up_in_world[0] - lean.x()) / sigma_rad;
    residual[1] = (up_in_world[1] - lean.y()) / sigma_rad;
    return true;
  }
};

// How far the walls as one camera sees them run from the common heading.
struct WallsResidual {
  Vector3d along_in_cam;
  double sigma_rad;
  template <typename T>
  bool operator()(const T* camera, const T* heading_rad, T* residual) const {
    const T along[3] = {T(along_in_cam.x()), T(along_in_cam.y()), T(along_in_cam.z())};
    T in_world[3];
    ceres::AngleAxisRotatePoint(camera, along, in_world);
    residual[0] =
        (cos(heading_rad[0]) * in_world[1] - sin(heading_rad[0]) * in_world[0]) / sigma_rad;
    return true;
  }
};

struct HeightResidual {
  double sigma;
  template <typename T>
  bool operator()(const T* camera, T* residual) const {
    residual[0] = (camera[5] - 1.0) / sigma;
    return true;
  }
};

// Holds place and yaw of one camera.
struct AnchorResidual {
  CameraBlock at;
  Vector3d forward_in_cam, left_in_world;
  template <typename T>
  bool operator()(const T* camera, T* residual) const {
    const T forward[3] = {T(forward_in_cam.x()), T(forward_in_cam.y()), T(forward_in_cam.z())};
    T in_world[3];
    ceres::AngleAxisRotatePoint(camera, forward, in_world);
    residual[0] = (camera[3] - at[3]) / kFixedSigma;
    residual[1] = (camera[4] - at[4]) / kFixedSigma;
    residual[2] = (in_world[0] * left_in_world.x() + in_world[1] * left_in_world.y()) / kFixedSigma;
    return true;
  }
};

struct FloorResidual {
  double floor, sigma;
  template <typename T>
  bool operator()(const T* point, T* residual) const {
    residual[0] = (point[2] - floor) / sigma;
    return true;
  }
};

struct CeilingResidual {
  double sigma;
  template <typename T>
  bool operator()(const T* point, const T* ceiling, T* residual) const {
    residual[0] = (point[2] - ceiling[0]) / sigma;
    return true;
  }
};

// Of headings modulo 90° the one near which most others are.
double CommonHeading(std::span<const double> headings_rad) {
  double best = 0;
  long most = -1;
  for (const double heading : headings_rad) {
    const auto count = std::count_if(headings_rad.begin(), headings_rad.end(), [&](double other) {
      return std::abs(WrapQuarter(other - heading)) < kSameHeading_rad;
    });
    if (count <= most) continue;
    most = count;
    best = heading;
  }
  return best;
}

// How far a camera is from where it was given.
struct GivenPoseResidual {
  GivenPoseResidual(const Rigid3& given, double position_sigma_m, double rotation_sigma_rad)
      : position(given.translation),
        position_sigma(position_sigma_m),
        rotation_sigma(rotation_sigma_rad) {
    std::array<double, 4> q{};
    ceres::AngleAxisToQuaternion(ToBlock(given).data(), q.data());
    cam_from_given = {q[0], -q[1], -q[2], -q[3]};
  }
  template <typename T>
  bool operator()(const T* camera, T* residual) const {
    const T inverse[4] = {T(cam_from_given[0]), T(cam_from_given[1]), T(cam_from_given[2]),
                          T(cam_from_given[3])};
    T quaternion[4], apart[4], turn[3];
    ceres::AngleAxisToQuaternion(camera, quaternion);
    ceres::QuaternionProduct(inverse, quaternion, apart);
    ceres::QuaternionToAngleAxis(apart, turn);
    for (int k = 0; k < 3; ++k) {
      residual[k] = (camera[3 + k] - position[k]) / position_sigma;
      residual[3 + k] = turn[k] / rotation_sigma;
    }
    return true;
  }
  Vector3d position;
  std::array<double, 4> cam_from_given{};
  double position_sigma, rotation_sigma;
};

// Where the verticals point in the world of given poses: level parts, the median of the cameras
// that are used; along z where errors of the given rotations explain that they do not.
Eigen::Vector2d LeanOf(std::span<const Rigid3> given, std::span<const Gravity> gravity,
                       const std::vector<bool>& is_used, double rotation_sigma_rad) {
  constexpr double kSignificance = 3;
  std::vector<double> x, y;
  for (size_t i = 0; i < given.size(); ++i) {
    if (!is_used[i]) continue;
    const Vector3d up = given[i].rotation * gravity[i].up_in_cam;
    x.push_back(up.x());
    y.push_back(up.y());
  }
  const Eigen::Vector2d lean(UpperMedian(x), UpperMedian(y));
  const double bound =
      kSignificance * rotation_sigma_rad / std::sqrt(static_cast<double>(x.size()));
  return lean.norm() < bound ? Eigen::Vector2d(0, 0) : lean;
}

// Cameras and points while they are refined, and what is known of them.
class Bundle {
 public:
  Bundle(std::span<const PanoFeatures> features, const BundleOptions& options,
         std::vector<Rigid3>& world_from_cam, std::vector<Track>& tracks)
      : features_(features), options_(options), world_from_cam_(world_from_cam), tracks_(tracks) {
    for (const Rigid3& pose : world_from_cam) blocks_.push_back(ToBlock(pose));
    is_used_.resize(world_from_cam.size(), false);
    AddRays();
  }

  void AddCameraPriors(std::span<const Gravity> gravity) {
    bool is_anchored = false;
    for (size_t i = 0; i < blocks_.size(); ++i) {
      if (!is_used_[i]) continue;
      AddVertical(gravity[i], {0, 0}, blocks_[i]);
      problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<HeightResidual, 1, 6>(
                                    new HeightResidual{options_.camera_height_sigma}),
                                new ceres::CauchyLoss(kHeightReach), blocks_[i].data());
      if (is_anchored) continue;
      is_anchored = true;
      const Rigid3& pose = world_from_cam_[i];
      // Of the level axes the one that the camera's x or z is nearest to the horizon along.
      const Vector3d forward = Vector3d::UnitX();
      const Vector3d in_world = pose.rotation * forward;
      const Vector3d left = Vector3d::UnitZ().cross(in_world).normalized();
      problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<AnchorResidual, 3, 6>(
                                    new AnchorResidual{blocks_[i], forward, left}),
                                nullptr, blocks_[i].data());
    }
  }

  void AddWalls(std::span<const Gravity> gravity) {
    std::vector<size_t> views;
    std::vector<Vector3d> along_in_cam;
    std::vector<double> headings_rad;
    for (size_t i = 0; i < blocks_.size(); ++i) {
      if (!is_used_[i] || !gravity[i].heading_rad) continue;
      const double azimuth = *gravity[i].heading_rad;
      const Vector3d along =
          LevelFromCam(gravity[i]).transpose() * Vector3d(std::cos(azimuth), std::sin(azimuth), 0);
      const Vector3d in_world = world_from_cam_[i].rotation * along;
      views.push_back(i);
      along_in_cam.push_back(along);
      headings_rad.push_back(std::atan2(in_world.y(), in_world.x()));
    }
    heading_rad_ = CommonHeading(headings_rad);
    for (size_t k = 0; k < views.size(); ++k) {
      if (std::abs(WrapQuarter(headings_rad[k] - heading_rad_)) > kSameHeading_rad) continue;
      // Of the walls' four directions the one along the heading itself.
      const double quarters = std::round((headings_rad[k] - heading_rad_) / (kPi / 2));
      const Vector3d up = gravity[views[k]].up_in_cam;
      const Vector3d turned = Eigen::AngleAxisd(-quarters * kPi / 2, up) * along_in_cam[k];
      problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<WallsResidual, 1, 6, 1>(
                                    new WallsResidual{turned, DegToRad(options_.wall_sigma_deg)}),
                                new ceres::CauchyLoss(1.0), blocks_[views[k]].data(),
                                &heading_rad_);
    }
  }

  void AddPlanes(LevelPlanes& planes) {
    const double reach = kPlaneReach * options_.plane_sigma;
    for (Track& track : tracks_) {
      if (std::abs(track.position.z() - planes.floor) < reach) {
        problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<FloorResidual, 1, 3>(
                                      new FloorResidual{planes.floor, options_.plane_sigma}),
                                  new ceres::CauchyLoss(1.0), track.position.data());
      }
      for (double& ceiling : planes.ceilings) {
        if (std::abs(track.position.z() - ceiling) >= reach) continue;
        problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<CeilingResidual, 1, 3, 1>(
                                      new CeilingResidual{options_.plane_sigma}),
                                  new ceres::CauchyLoss(1.0), track.position.data(), &ceiling);
        break;
      }
    }
  }

  void AddGivenPoses(std::span<const Rigid3> given, std::span<const Gravity> gravity,
                     const GivenPoseSigmas& sigmas) {
    const Eigen::Vector2d lean = LeanOf(given, gravity, is_used_, sigmas.rotation_rad);
    for (size_t i = 0; i < blocks_.size(); ++i) {
      if (!is_used_[i]) continue;
      problem_.AddResidualBlock(
          new ceres::AutoDiffCostFunction<GivenPoseResidual, 6, 6>(
              new GivenPoseResidual(given[i], sigmas.position_m, sigmas.rotation_rad)),
          new ceres::CauchyLoss(2.0), blocks_[i].data());
      AddVertical(gravity[i], lean, blocks_[i]);
    }
  }

  // Makes the cameras' mean height one again, those far from most counting less. Errors of points
  // on level planes shrink with everything, which holds cameras below their height the more, the
  // more points there are: thousands stand against a dozen cameras.
  void ScaleToCameraHeight(LevelPlanes& planes) {
    std::vector<double> heights;
    for (size_t i = 0; i < blocks_.size(); ++i) {
      if (is_used_[i]) heights.push_back(world_from_cam_[i].translation.z());
    }
    const double middle = UpperMedian(heights);
    double weight = 0, sum = 0;
    for (const double height : heights) {
      const double apart = (height - middle) / (kHeightReach * options_.camera_height_sigma);
      const double own = 1 / (1 + apart * apart);
      weight += own;
      sum += own * height;
    }
    if (sum <= 0) return;
    const double scale = weight / sum;
    const auto first = std::find(is_used_.begin(), is_used_.end(), true) - is_used_.begin();
    Vector3d fixed = world_from_cam_[static_cast<size_t>(first)].translation;
    fixed.z() = planes.floor;
    const auto scaled = [&](const Vector3d& at) -> Vector3d {
      return fixed + scale * (at - fixed);
    };
    for (size_t i = 0; i < blocks_.size(); ++i) {
      if (is_used_[i]) world_from_cam_[i].translation = scaled(world_from_cam_[i].translation);
    }
    for (Track& track : tracks_) track.position = scaled(track.position);
    for (double& ceiling : planes.ceilings)
      ceiling = planes.floor + scale * (ceiling - planes.floor);
  }

  double Solve() {
    ceres::Solver::Options solver;
    constexpr int kMaxDenseCameras = 120;
    solver.linear_solver_type =
        blocks_.size() > kMaxDenseCameras ? ceres::SPARSE_SCHUR : ceres::DENSE_SCHUR;
    solver.max_num_iterations = options_.max_iterations;
    solver.num_threads = 1;  // sums of several threads differ in their last bits
    solver.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    if (problem_.NumResidualBlocks() > 0) ceres::Solve(solver, &problem_, &summary);
    for (size_t i = 0; i < blocks_.size(); ++i) {
      if (is_used_[i]) world_from_cam_[i] = ToPose(blocks_[i]);
    }
    return RootMeanSquare();
  }

 private:
  void AddVertical(const Gravity& gravity, const Eigen::Vector2d& lean, CameraBlock& block) {
    problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<VerticalResidual, 2, 6>(
                                  new VerticalResidual{gravity.up_in_cam, gravity.sigma_rad, lean}),
                              new ceres::CauchyLoss(2.0), block.data());
  }

  [[nodiscard]] Vector3d RayOf(const Observation& observation) const {
    return features_[static_cast<size_t>(observation.view_idx)]
        .rays[static_cast<size_t>(observation.feature_idx)]
        .cast<double>();
  }

  void AddRays() {
    const double sigma_rad = DegToRad(options_.ray_sigma_deg);
    for (Track& track : tracks_) {
      for (const Observation& observation : track.observations) {
        problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<RayResidual, 2, 6, 3>(
                                      new RayResidual(RayOf(observation), sigma_rad)),
                                  new ceres::CauchyLoss(2.0),
                                  blocks_[static_cast<size_t>(observation.view_idx)].data(),
                                  track.position.data());
        is_used_[static_cast<size_t>(observation.view_idx)] = true;
      }
    }
  }

  [[nodiscard]] double RootMeanSquare() const {
    double sum = 0, count = 0;
    for (const Track& track : tracks_) {
      for (const Observation& observation : track.observations) {
        const Rigid3& pose = world_from_cam_[static_cast<size_t>(observation.view_idx)];
        const Vector3d to_point = pose.rotation.transpose() * (track.position - pose.translation);
        sum += RayOf(observation).cross(to_point.normalized()).squaredNorm();
        count += 1;
      }
    }
    return count > 0 ? std::sqrt(sum / count) : 0;
  }

  std::span<const PanoFeatures> features_;
  const BundleOptions& options_;
  std::vector<Rigid3>& world_from_cam_;
  std::vector<Track>& tracks_;
  std::vector<CameraBlock> blocks_;
  std::vector<bool> is_used_;
  double heading_rad_ = 0;
  ceres::Problem problem_;
};

}  // namespace

double AdjustBundle(std::span<const PanoFeatures> features, std::span<const Gravity> gravity,
                    const BundleOptions& options, std::vector<Rigid3>& world_from_cam,
                    std::vector<Track>& tracks, LevelPlanes& planes) {
  Bundle bundle(features, options, world_from_cam, tracks);
  bundle.AddCameraPriors(gravity);
  bundle.AddWalls(gravity);
  bundle.AddPlanes(planes);
  const double error_rad = bundle.Solve();
  bundle.ScaleToCameraHeight(planes);
  return error_rad;
}

double AdjustGivenPoses(std::span<const PanoFeatures> features, std::span<const Rigid3> given,
                        std::span<const Gravity> gravity, const GivenPoseSigmas& sigmas,
                        const BundleOptions& options, std::vector<Rigid3>& world_from_cam,
                        std::vector<Track>& tracks) {
  Bundle bundle(features, options, world_from_cam, tracks);
  bundle.AddGivenPoses(given, gravity, sigmas);
  return bundle.Solve();
}

}  // namespace enfilade
