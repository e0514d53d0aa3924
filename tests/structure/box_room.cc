// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/structure/box_room.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "enfilade/geometry/angles.h"
#include "enfilade/geometry/rigid3.h"
#include "enfilade/structure/types.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct PlanHitOfBox {
  double distance;  // in lengths of the ray
  int axis;         // of the wall's normal
  bool is_max_side;
};

PlanHitOfBox HitBox(const BoxRoom& room, const Vector2d& from, const Vector2d& ray) {
  PlanHitOfBox hit{1e9, 0, false};
  for (int axis = 0; axis < 2; ++axis) {
    if (std::abs(ray[axis]) < 1e-12) continue;
    const bool is_max_side = ray[axis] > 0;
    const double bound = is_max_side ? room.max[axis] : room.min[axis];
    const double distance = (bound - from[axis]) / ray[axis];
    if (distance < hit.distance) hit = {distance, axis, is_max_side};
  }
  return hit;
}

Vector2d Turned(const Vector2d& v, double rad) {
  return {std::cos(rad) * v.x() - std::sin(rad) * v.y(),
          std::sin(rad) * v.x() + std::cos(rad) * v.y()};
}

Vector2d Direction(double azimuth) { return {std::cos(azimuth), std::sin(azimuth)}; }

// A pattern without period over the size of a room.
double Pattern(double along, double z) {
  return 0.4 * std::sin(7.1 * along + 1.3 * std::sin(3.1 * z)) +
         0.3 * std::sin(17.3 * along + 5.0 * z) +
         0.3 * std::sin(11.3 * along + 2.0 * std::sin(along));
}

}  // namespace

double BoxRoom::Grey(const Vector3d& position, const Vector3d& ray) const {
  const Vector2d from = Turned(position.head<2>(), -heading_rad);
  const Vector2d to = Turned(ray.head<2>(), -heading_rad);
  const PlanHitOfBox hit = HitBox(*this, from, to);
  const double z = position.z() + hit.distance * ray.z();
  if (z < floor_z) return floor_grey;
  if (z > ceiling_z) return ceiling_grey;
  if (z < floor_z + baseboard_m) return baseboard_grey;
  const double along = (from + hit.distance * to)[1 - hit.axis];
  const double shading = (hit.axis == 0 ? 1 : -1) * wall_shading * (hit.is_max_side ? 1.0 : 0.5);
  const double pattern = Pattern(along + (hit.is_max_side ? 0.0 : 11.0), z);
  return wall_grey + shading + wall_slope * along + wall_texture * pattern;
}

double BoxRoom::WallDistance(const Vector2d& position, double azimuth_rad) const {
  return HitBox(*this, Turned(position, -heading_rad), Direction(azimuth_rad - heading_rad))
      .distance;
}

int BoxRoom::WallFamily(const Vector2d& position, double azimuth_rad) const {
  return HitBox(*this, position, Direction(azimuth_rad)).axis == 0 ? 1 : 0;
}

LevelPanorama DrawPanorama(const BoxRoom& room, const Vector3d& position, int width, double noise,
                           int seed, int rays_per_side) {
  const int rows = width / 2;
  LevelPanorama panorama{position, ImageU8(rows, width, 3), ImageU8(rows, width, 1, 1)};
  std::mt19937 random(static_cast<uint32_t>(seed));
  std::normal_distribution<double> gauss(0, 1);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < width; ++c) {
      double grey = 0;
      for (int i = 0; i < rays_per_side * rays_per_side; ++i) {
        const double x = c + (i % rays_per_side + 0.5) / rays_per_side;
        const double y = r + (i / rays_per_side + 0.5) / rays_per_side;
        const double azimuth = 2 * kPi * x / width - kPi, elevation = kPi * (0.5 - y / rows);
        grey += room.Grey(position, {std::cos(elevation) * std::cos(azimuth),
                                     std::cos(elevation) * std::sin(azimuth), std::sin(elevation)});
      }
      grey /= rays_per_side * rays_per_side;
      for (int channel = 0; channel < 3; ++channel) {
        const double value = grey + noise * gauss(random);
        panorama.rgb(r, c, channel) = static_cast<uint8_t>(std::clamp(value + 0.5, 0.0, 255.0));
      }
    }
  }
  return panorama;
}

ColumnTruth TruthOfColumns(const BoxRoom& room, const Vector2d& position, int num_columns) {
  ColumnTruth truth;
  for (int c = 0; c < num_columns; ++c) {
    const double azimuth = AzimuthOfColumn(c, num_columns);
    truth.wall_m.push_back(room.WallDistance(position, azimuth));
    truth.family.push_back(room.WallFamily(position, azimuth));
  }
  return truth;
}

LineResponse PerfectResponse(const ColumnTruth& truth, int rows,
                             const std::vector<double>& heights_m) {
  const int num_columns = static_cast<int>(truth.wall_m.size());
  LineResponse response{std::vector<ImageU8>(kNumFamilies)};
  for (const size_t f : {0, 1}) response.family[f] = ImageU8(rows, num_columns);
  for (int c = 0; c < num_columns; ++c) {
    const size_t i = static_cast<size_t>(c);
    ImageU8& picture = response.family[static_cast<size_t>(truth.family[i])];
    for (const double height_m : heights_m) {
      const double row = rows * (0.5 - std::atan(height_m / truth.wall_m[i]) / kPi) - 0.5;
      for (int r = std::max(0, static_cast<int>(row) - 3);
           r <= std::min(rows - 1, static_cast<int>(row) + 4); ++r) {
        const double value = 250 * std::exp(-0.5 * (r - row) * (r - row));
        picture(r, c) = std::max(picture(r, c), static_cast<uint8_t>(value));
      }
    }
  }
  return response;
}

ColumnScores PerfectScores(const ColumnTruth& truth, const DistanceBins& bins, double peak,
                           double reach) {
  const int num_columns = static_cast<int>(truth.wall_m.size());
  ColumnScores scores;
  for (const size_t f : {0, 1}) scores.family[f] = ImageF(num_columns, bins.count);
  for (int c = 0; c < num_columns; ++c) {
    const size_t i = static_cast<size_t>(c);
    const double bin = bins.Bin(truth.wall_m[i]);
    for (int b = 0; b < bins.count; ++b) {
      scores.family[static_cast<size_t>(truth.family[i])](c, b) =
          static_cast<float>(peak * std::max(0.0, 1 - std::abs(b - bin) / reach));
    }
  }
  return scores;
}

}  // namespace enfilade
