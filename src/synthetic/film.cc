// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/synthetic/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "enfilade/base/check.h"
#include "enfilade/base/errors.h"
#include "enfilade/geometry/angles.h"
#include "src/synthetic/cameras.h"
#include "src/synthetic/standing_space.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr double kSpeed_m_s = 0.8;
constexpr double kTurn_rad_s = kPi / 2;
constexpr double kMaxStep_m = 1;

void CheckUpright(const Home& walk) {
  for (const HomeCamera& camera : walk.cameras) {
    if (camera.home_from_cam.rotation(2, 1) < -1 + 1e-9) continue;
    throw InvalidInputError("pictures.kind", "is video, and " + camera.picture + " leans",
                            "leave home.tilt_deg at 0");
  }
}

// Position, and heading without jumps of a turn, of every camera.
std::vector<Vector4d> PosesOf(const Home& walk) {
  CheckUpright(walk);
  std::vector<Vector4d> poses;
  for (const HomeCamera& camera : walk.cameras) {
    const Rigid3& pose = camera.home_from_cam;
    const Vector3d& p = pose.translation;
    double azimuth = std::atan2(pose.rotation(1, 2), pose.rotation(0, 2));
    if (!poses.empty()) {
      if ((p - poses.back().head<3>()).norm() > kMaxStep_m) {
        poses.clear();
        break;
      }
      azimuth = poses.back()[3] + WrapPi(azimuth - poses.back()[3]);
    }
    poses.emplace_back(p.x(), p.y(), p.z(), azimuth);
  }
  if (poses.size() < 2) {
    throw InvalidInputError("pictures.kind", "is video, and the home's cameras follow no path",
                            "give the preset walk");
  }
  return poses;
}

// A uniform cubic B-spline that starts and ends where its control points do.
class Spline {
 public:
  explicit Spline(const std::vector<Vector4d>& points) {
    const size_t n = points.size();
    controls_.push_back(2 * points[0] - points[1]);
    controls_.insert(controls_.end(), points.begin(), points.end());
    controls_.push_back(2 * points[n - 1] - points[n - 2]);
  }

  /// Where t reaches the last point.
  [[nodiscard]] double End() const { return static_cast<double>(controls_.size()) - 3; }

  [[nodiscard]] Vector4d At(double t) const {
    const auto i = static_cast<size_t>(std::clamp(std::floor(t), 0.0, End() - 1));
    const double u = t - static_cast<double>(i), v = 1 - u;
    return (v * v * v * controls_[i] + (3 * u * u * u - 6 * u * u + 4) * controls_[i + 1] +
            (3 * v * v * v - 6 * v * v + 4) * controls_[i + 2] + u * u * u * controls_[i + 3]) /
           6;
  }

 private:
  std::vector<Vector4d> controls_;
};

// Seconds that it takes from one pose to a near one.
double SecondsBetween(const Vector4d& a, const Vector4d& b) {
  return std::max((b - a).head<3>().norm() / kSpeed_m_s, std::abs(b[3] - a[3]) / kTurn_rad_s);
}

// Poses at even times along the spline.
std::vector<Vector4d> PosesInTime(const Spline& spline, double frame_s) {
  constexpr int kPerPoint = 64;  // short against a frame
  const int num_parts = static_cast<int>(spline.End()) * kPerPoint;
  std::vector<Vector4d> poses = {spline.At(0)};
  double left_s = frame_s;
  for (int i = 0; i < num_parts; ++i) {
    const double t0 = static_cast<double>(i) / kPerPoint,
                 t1 = static_cast<double>(i + 1) / kPerPoint;
    const double part_s = SecondsBetween(spline.At(t0), spline.At(t1));
    double begin_s = 0;
    for (; part_s - begin_s >= left_s; left_s = frame_s) {
      begin_s += left_s;
      poses.push_back(spline.At(t0 + begin_s / part_s * (t1 - t0)));
    }
    left_s -= part_s - begin_s;
  }
  return poses;
}

}  // namespace

Home FilmWalk(const Home& walk, double frames_per_second) {
  ENFILADE_CHECK(frames_per_second > 0);
  const Spline spline(PosesOf(walk));
  Home film = walk;
  film.cameras.clear();
  const StandingSpace space(walk, walk.StoreyOfCamera(0));
  int room_id = walk.cameras[0].room_id;
  for (const Vector4d& pose : PosesInTime(spline, 1 / frames_per_second)) {
    room_id = space.RoomAt(pose.head<2>()).value_or(room_id);
    AddCamera(film, room_id, pose.head<3>(), pose[3]);
    film.cameras.back().picture = fmt::format("frame_{:06}.jpg", film.cameras.size() - 1);
  }
  return film;
}

}  // namespace enfilade
