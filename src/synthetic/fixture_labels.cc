// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/synthetic/fixture_labels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/scene/camera.h"
#include "enfilade/synthetic/render.h"
#include "src/synthetic/lamp.h"
#include "src/synthetic/random.h"
#include "src/synthetic/ray_scene.h"

namespace enfilade {
namespace {

using Eigen::Vector3f;

// One value a column, standard normal, with a Gaussian correlation of the given length in columns:
// white noise smoothed round the panorama.
std::vector<double> CorrelatedNoise(int num_columns, double correlation_columns, Random& random) {
  std::vector<double> white(static_cast<size_t>(num_columns));
  for (double& value : white) value = random.Normal();
  // A Gaussian convolved with itself is wider by √2.
  const double sigma = correlation_columns / std::sqrt(2.0);
  const int reach = std::min(static_cast<int>(4 * sigma), (num_columns - 1) / 2);
  std::vector<double> smooth(white.size(), 0);
  double squares = 0;
  for (int k = -reach; k <= reach; ++k) {
    const double weight = k == 0 ? 1 : std::exp(-0.5 * k * k / (sigma * sigma));
    squares += weight * weight;
    for (int c = 0; c < num_columns; ++c) {
      smooth[static_cast<size_t>(c)] +=
          weight * white[static_cast<size_t>((c + k + num_columns) % num_columns)];
    }
  }
  for (double& value : smooth) value /= std::sqrt(squares);
  return smooth;
}

// A jittered grid over a panorama: every pixel belongs to the nearest of the cells' seeds.
class Blobs {
 public:
  Blobs(ImageSize size, double blob_deg, uint64_t seed)
      : num_cols_(std::max(3, static_cast<int>(std::lround(360 / blob_deg)))),
        num_rows_(std::max(1, static_cast<int>(std::lround(180 / blob_deg)))),
        cell_width_(static_cast<double>(size.width) / num_cols_),
        cell_height_(static_cast<double>(size.height) / num_rows_),
        seed_(seed) {}

  /// Number of the blob of a pixel.
  [[nodiscard]] uint64_t At(int row, int col) const {
    const double x = (col + 0.5) / cell_width_, y = (row + 0.5) / cell_height_;
    const int c0 = static_cast<int>(x), r0 = static_cast<int>(y);
    uint64_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int r = std::max(r0 - 1, 0); r <= std::min(r0 + 1, num_rows_ - 1); ++r) {
      for (int c = c0 - 1; c <= c0 + 1; ++c) {
        const auto cell = static_cast<uint64_t>(r * num_cols_ + (c + num_cols_) % num_cols_);
        Random random(PartSeed(seed_, cell));
        const double dx = c + random.Uniform() - x, dy = r + random.Uniform() - y;
        if (dx * dx + dy * dy >= least) continue;
        least = dx * dx + dy * dy;
        nearest = cell;
      }
    }
    return nearest;
  }

 private:
  int num_cols_, num_rows_;
  double cell_width_, cell_height_;
  uint64_t seed_;
};

// The true labels with their boundaries moved.
ImageU8 MovedLabels(const Home& home, int camera_idx, ImageSize size, const LabelNoise& noise,
                    uint64_t seed) {
  const int storey_idx = home.StoreyOfCamera(camera_idx);
  const std::vector<Surface> surfaces = MakeSurfaces(home, storey_idx);
  const RayScene scene(surfaces);
  const std::vector<LampShade> shades = MakeLampShades(home, storey_idx);
  const Rigid3& home_from_cam = home.cameras[static_cast<size_t>(camera_idx)].home_from_cam;
  const Vector3f origin = home_from_cam.translation.cast<float>();
  const Camera camera = EquirectangularCamera(size.width, size.height);
  const double px_per_deg = size.height / 180.0, horizon = 0.5 * size.height;
  const double correlation_columns = noise.correlation_deg * size.width / 360;
  Random above(PartSeed(seed, 0)), below(PartSeed(seed, 1));
  const std::vector<double> up = CorrelatedNoise(size.width, correlation_columns, above),
                            down = CorrelatedNoise(size.width, correlation_columns, below);
  ImageU8 labels(size.height, size.width);
  for (int row = 0; row < size.height; ++row) {
    for (int col = 0; col < size.width; ++col) {
      const bool is_above = row + 0.5 < horizon;
      const double sigmas = (is_above ? up : down)[static_cast<size_t>(col)];
      const double moved = row + 0.5 + noise.boundary_sigma_deg * px_per_deg * sigmas;
      const double y = is_above ? std::clamp(moved, 0.0, horizon)
                                : std::clamp<double>(moved, horizon, size.height);
      const Vector3f ray =
          (home_from_cam.rotation * camera.RayFromPixel({col + 0.5, y})).normalized().cast<float>();
      const std::optional<RayHit> hit = scene.Trace(origin, ray);
      if (!hit || TraceLamps(shades, origin, ray, hit->distance_m)) continue;  // other
      labels(row, col) =
          static_cast<uint8_t>(surfaces[static_cast<size_t>(hit->surface_idx)].label);
    }
  }
  return labels;
}

SurfaceLabel Confused(SurfaceLabel label, bool is_above) {
  switch (label) {
    case SurfaceLabel::kFloor:
    case SurfaceLabel::kCeiling:
      return SurfaceLabel::kWall;
    case SurfaceLabel::kWall:
      return is_above ? SurfaceLabel::kCeiling : SurfaceLabel::kFloor;
    case SurfaceLabel::kOther:
      break;
  }
  return label;
}

void ConfuseBlobs(const LabelNoise& noise, uint64_t seed, ImageU8& labels) {
  const Blobs blobs({labels.cols(), labels.rows()}, noise.blob_deg, PartSeed(seed, 2));
  for (int row = 0; row < labels.rows(); ++row) {
    for (int col = 0; col < labels.cols(); ++col) {
      Random random(PartSeed(PartSeed(seed, 3), blobs.At(row, col)));
      const bool is_confused = random.Chance(noise.blob_share);
      const bool is_furniture_wall = random.Chance(noise.furniture_as_wall_share);
      auto label = static_cast<SurfaceLabel>(labels(row, col));
      if (label == SurfaceLabel::kOther && is_furniture_wall) {
        label = SurfaceLabel::kWall;
      } else if (is_confused) {
        label = Confused(label, 2 * row + 1 < labels.rows());
      }
      labels(row, col) = static_cast<uint8_t>(label);
    }
  }
}

}  // namespace

ImageU8 FixtureLabels(const Home& home, int camera_idx, ImageSize size, const LabelNoise& noise) {
  ENFILADE_CHECK(camera_idx >= 0 && camera_idx < static_cast<int>(home.cameras.size()));
  ENFILADE_CHECK(size.width > 0 && size.height > 0 && noise.blob_deg > 0);
  ENFILADE_CHECK(noise.boundary_sigma_deg >= 0 && noise.correlation_deg >= 0);
  const uint64_t seed = PartSeed(noise.seed, static_cast<uint64_t>(camera_idx));
  ImageU8 labels = MovedLabels(home, camera_idx, size, noise, seed);
  ConfuseBlobs(noise, seed, labels);
  return labels;
}

}  // namespace enfilade
