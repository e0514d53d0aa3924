// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/baselines/surface_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/geometry/polygon2.h"
#include "src/baselines/oriented_points.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kRaysRound = 512;  // on the horizon
// Half the length of the chord that tells a wall's direction: 3 degrees see 8 cm of a wall 1.5 m
// away, more than its distance is wrong between neighbours.
constexpr double kHalfChord_deg = 3;

// A panorama's wall profile in the plan, the camera at the origin.
class ProfileCurve {
 public:
  explicit ProfileCurve(const WallProfile& profile)
      : profile_(profile),
        half_chord_(std::max(
            1, static_cast<int>(std::lround(profile.num_columns() * kHalfChord_deg / 360)))) {}

  [[nodiscard]] bool IsKnown(int column) const {
    const size_t i = Wrap(column);
    return profile_.is_seen[i] != 0 && std::isfinite(profile_.wall_m[i]) && profile_.wall_m[i] > 0;
  }
  [[nodiscard]] Vector2d Direction(int column) const {
    const double azimuth = AzimuthOfColumn(static_cast<int>(Wrap(column)), profile_.num_columns());
    return {std::cos(azimuth), std::sin(azimuth)};
  }
  [[nodiscard]] double Distance(int column) const { return profile_.wall_m[Wrap(column)]; }

  // Of the wall at a column, looking at the camera: across the straightest of the chords over it,
  // before it and after it.
  [[nodiscard]] Vector2d Normal(int column) const {
    constexpr std::array<std::array<int, 2>, 3> kChords = {{{-1, 1}, {-1, 0}, {0, 1}}};
    Vector2d along(0, 0);
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [first, last] : kChords) {
      const int a = column + first * half_chord_, b = column + last * half_chord_;
      const double sag = Sag(a, b);
      if (sag >= least) continue;
      least = sag;
      along = Point(b) - Point(a);
    }
    const Vector2d towards_camera = -Direction(column);
    if (!(along.norm() > 0)) return towards_camera;
    const Vector2d normal = Vector2d(-along.y(), along.x()).normalized();
    return normal.dot(towards_camera) < 0 ? Vector2d(-normal) : normal;
  }

 private:
  [[nodiscard]] size_t Wrap(int column) const {
    const int n = profile_.num_columns();
    return static_cast<size_t>(((column % n) + n) % n);
  }
  [[nodiscard]] Vector2d Point(int column) const { return Distance(column) * Direction(column); }
  // How far the columns from a to b lie from the chord between them, at most; infinite where one of
  // them is unknown.
  [[nodiscard]] double Sag(int a, int b) const {
    double sag = 0;
    for (int c = a; c <= b; ++c) {
      if (!IsKnown(c)) return std::numeric_limits<double>::infinity();
    }
    const Vector2d from = Point(a), to = Point(b);
    for (int c = a + 1; c < b; ++c) sag = std::max(sag, DistanceToSegment(Point(c), from, to));
    return sag;
  }

  const WallProfile& profile_;
  const int half_chord_;
};

// Where a ray of this slope (height over distance) ends: a wall, a floor or a ceiling.
ScenePoint EndOfRay(const ProfileCurve& curve, const WallProfile& profile, const Vector3d& camera,
                    int column, double slope) {
  ScenePoint point;
  point.view_idx = {profile.view_idx};
  double distance = curve.Distance(column);
  const double z = camera.z() + slope * distance;
  if (z > profile.ceiling_z) {
    distance = (profile.ceiling_z - camera.z()) / slope;
    point.normal = -Vector3d::UnitZ();
  } else if (z < profile.floor_z) {
    distance = (profile.floor_z - camera.z()) / slope;
    point.normal = Vector3d::UnitZ();
  } else {
    point.normal.head<2>() = curve.Normal(column);
  }
  point.position.head<2>() = camera.head<2>() + distance * curve.Direction(column);
  point.position.z() = camera.z() + slope * distance;
  return point;
}

std::vector<ScenePoint> PointsOfProfile(const WallProfile& profile, const Scene& scene,
                                        const Structure& structure) {
  std::vector<ScenePoint> points;
  const View& view = scene.views[static_cast<size_t>(profile.view_idx)];
  const Vector3d camera = structure.home_from_world * view.world_from_cam.translation;
  const Rigid3 world_from_home = structure.home_from_world.Inverse();
  if (!(profile.floor_z < camera.z() && camera.z() < profile.ceiling_z)) return points;
  const ProfileCurve curve(profile);
  constexpr int kRows = kRaysRound / 2;
  for (int row = 0; row < kRows; ++row) {
    const double elevation = kPi * ((row + 0.5) / kRows - 0.5);
    const int num_rays =
        std::max(1, static_cast<int>(std::lround(kRaysRound * std::cos(elevation))));
    for (int ray = 0; ray < num_rays; ++ray) {
      const int column = static_cast<int>((ray + 0.5) / num_rays * profile.num_columns());
      if (!curve.IsKnown(column)) continue;
      ScenePoint point = EndOfRay(curve, profile, camera, column, std::tan(elevation));
      point.position = world_from_home * point.position;
      point.normal = world_from_home.rotation * point.normal;
      points.push_back(std::move(point));
    }
  }
  return points;
}

std::vector<ScenePoint> PointsOfStructure(const Scene& scene, const Structure& structure,
                                          RunContext& context) {
  ENFILADE_CHECK(structure.profiles.size() == scene.views.size());
  std::vector<std::vector<ScenePoint>> of_view(structure.profiles.size());
  ParallelFor(context, "", static_cast<int64_t>(of_view.size()), [&](int64_t i) {
    const size_t idx = static_cast<size_t>(i);
    of_view[idx] = PointsOfProfile(structure.profiles[idx], scene, structure);
  });
  std::vector<ScenePoint> points;
  for (std::vector<ScenePoint>& some : of_view)
    std::move(some.begin(), some.end(), std::back_inserter(points));
  return points;
}

}  // namespace

std::vector<ScenePoint> SurfacePoints(const Scene& scene, const Structure& structure,
                                      RunContext& context) {
  std::vector<ScenePoint> points;
  std::copy_if(scene.points.begin(), scene.points.end(), std::back_inserter(points), IsOriented);
  return points.size() >= kMinSurfacePoints ? points : PointsOfStructure(scene, structure, context);
}

}  // namespace enfilade
