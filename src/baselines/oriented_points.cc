// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/baselines/oriented_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstdint>
#include <utility>

#include "enfilade/base/check.h"
#include "enfilade/baselines/surface_points.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

// Of a cube of the grid, and the axis that a normal is nearest to, with its sign.
struct CubeKey {
  std::array<int64_t, 3> cube;
  int heading = 0;
  size_t sample_idx = 0;

  auto operator<=>(const CubeKey&) const = default;
  [[nodiscard]] bool IsSameCube(const CubeKey& other) const {
    return cube == other.cube && heading == other.heading;
  }
};

CubeKey KeyOf(const SurfaceSample& sample, size_t sample_idx, double spacing_m) {
  CubeKey key{.cube = {}, .heading = 0, .sample_idx = sample_idx};
  for (int k = 0; k < 3; ++k)
    key.cube[static_cast<size_t>(k)] =
        static_cast<int64_t>(std::floor(sample.position[k] / spacing_m));
  int axis = 0;
  sample.normal.cwiseAbs().maxCoeff(&axis);
  key.heading = 2 * axis + (sample.normal[axis] < 0 ? 1 : 0);
  return key;
}

}  // namespace

bool IsOriented(const ScenePoint& point) {
  return point.position.allFinite() && point.normal.allFinite() &&
         std::abs(point.normal.norm() - 1) < 0.01 && !point.view_idx.empty();
}

std::vector<SurfaceSample> SamplesOf(const Scene& scene, const Structure& structure,
                                     const std::vector<ScenePoint>& points, double max_range_m) {
  std::vector<Vector3d> cameras;
  for (const View& view : scene.views)
    cameras.push_back(structure.home_from_world * view.world_from_cam.translation);
  std::vector<SurfaceSample> samples;
  for (const ScenePoint& point : points) {
    if (!IsOriented(point)) continue;
    const Vector3d position = structure.home_from_world * point.position;
    const Vector3d normal = structure.home_from_world.rotation * point.normal.normalized();
    for (const int view_idx : point.view_idx) {
      ENFILADE_CHECK(view_idx >= 0 && static_cast<size_t>(view_idx) < cameras.size());
      const Vector3d& camera = cameras[static_cast<size_t>(view_idx)];
      const double side = normal.dot(camera - position);
      if ((camera - position).norm() > max_range_m || side == 0) continue;
      samples.push_back({position, side > 0 ? normal : Vector3d(-normal), camera});
    }
  }
  return samples;
}

std::vector<SurfaceSample> Thinned(const std::vector<SurfaceSample>& samples, double spacing_m) {
  std::vector<CubeKey> keys;
  keys.reserve(samples.size());
  for (size_t i = 0; i < samples.size(); ++i) keys.push_back(KeyOf(samples[i], i, spacing_m));
  std::sort(keys.begin(), keys.end());
  std::vector<SurfaceSample> thinned;
  for (size_t first = 0, last = 0; first < keys.size(); first = last) {
    SurfaceSample mean{Vector3d::Zero(), Vector3d::Zero(), samples[keys[first].sample_idx].camera};
    for (; last < keys.size() && keys[last].IsSameCube(keys[first]); ++last) {
      const SurfaceSample& sample = samples[keys[last].sample_idx];
      mean.position += sample.position;
      mean.normal += sample.normal;
    }
    const auto count = static_cast<double>(last - first);
    thinned.push_back({mean.position / count, mean.normal.normalized(), mean.camera});
  }
  return thinned;
}

std::string ReasonForTooFew(const std::vector<SurfaceSample>& samples) {
  if (samples.size() >= kMinSurfacePoints) return {};
  return fmt::format(
      "only {} points with a normal and a view lie within range and apart, a surface takes {}",
      samples.size(), kMinSurfacePoints);
}

}  // namespace enfilade
