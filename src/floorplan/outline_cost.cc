// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/outline_cost.h"

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kStopped = 0.05;  // of the view outwards is left behind a wall

// The value of the cell that holds the point, 0 outside.
float At(const GridFrame& frame, const ImageF& image, const Vector2d& p) {
  const Vector2d pixel = (p - frame.origin) / frame.cell_m;
  const int row = static_cast<int>(std::floor(pixel.y()));
  const int col = static_cast<int>(std::floor(pixel.x()));
  const bool is_inside = row >= 0 && col >= 0 && row < image.rows() && col < image.cols();
  return is_inside ? image(row, col) : 0;
}

}  // namespace

void AddEdgeCost(const LoopField& field, const FloorplanOptions& options, const Vector2d& a,
                 const Vector2d& b, OutlineCost& cost) {
  const double length = (b - a).norm(), cell_m = field.frame.cell_m;
  if (length <= 0) return;
  const Vector2d along = (b - a) / length, inward(-along.y(), along.x());
  const int num_steps = std::max(1, static_cast<int>(std::lround(length / cell_m)));
  const int depth = std::max(1, static_cast<int>(std::lround(options.free_depth_m / cell_m)));
  const double step_m = length / num_steps;
  OutlineCost edge;
  for (int k = 0; k < num_steps; ++k) {
    const Vector2d left = a + (k + 0.5) * step_m * along + 0.5 * cell_m * inward;
    const Vector2d right = left - cell_m * inward;
    edge.unseen_m += step_m * (1 - std::max(At(field.frame, field.faceness, left),
                                            At(field.frame, field.faceness, right)));
    double passed = 1;  // how much of the way outwards one can look along
    for (int d = 0; d < depth; ++d) {
      const Vector2d outside = right - d * cell_m * inward, inside = left + d * cell_m * inward;
      const double free = At(field.frame, field.freeness, outside);
      const double face = At(field.frame, field.faceness, outside);
      if (passed > kStopped) edge.free_outside_m2 += step_m * cell_m * passed * std::max(free, 0.0);
      passed *= 1 - std::max(std::max(-free, 0.0), face);
      edge.solid_inside_m2 +=
          step_m * cell_m * std::max(-At(field.frame, field.freeness, inside), 0.0F);
    }
  }
  cost.length_m += length;
  cost.unseen_m += edge.unseen_m;
  cost.free_outside_m2 += edge.free_outside_m2;
  cost.solid_inside_m2 += edge.solid_inside_m2;
  cost.total_m += edge.unseen_m + options.outside_weight * edge.free_outside_m2 +
                  options.inside_weight * edge.solid_inside_m2;
}

void AddCornerCosts(const FloorplanOptions& options, int num_corners, OutlineCost& cost) {
  cost.num_corners += num_corners;
  cost.total_m += num_corners * options.turn_cost_m;
}

}  // namespace enfilade
