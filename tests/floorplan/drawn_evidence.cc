// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/floorplan/drawn_evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "enfilade/geometry/boolean.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

double DistanceToRings(const MultiPolygon2& region, const Vector2d& p) {
  double distance = std::numeric_limits<double>::infinity();
  const auto visit = [&](const Ring2& ring) {
    for (size_t i = 0; i < ring.size(); ++i) {
      distance = std::min(distance, DistanceToSegment(p, ring[i], ring[(i + 1) % ring.size()]));
    }
  };
  for (const Polygon2& polygon : region) {
    visit(polygon.outer);
    for (const Ring2& hole : polygon.holes) visit(hole);
  }
  return distance;
}

GridFrame FrameOf(const MultiPolygon2& region, const DrawOptions& options) {
  Vector2d low = region.front().outer.front(), high = low;
  for (const Polygon2& polygon : region) {
    for (const Vector2d& p : polygon.outer) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  GridFrame frame;
  frame.cell_m = options.cell_m;
  frame.origin = ((low.array() - options.margin_m) / options.cell_m).floor() * options.cell_m;
  const Vector2d size = (high.array() + options.margin_m - frame.origin.array()) / options.cell_m;
  frame.rows = static_cast<int>(std::ceil(size.y()));
  frame.cols = static_cast<int>(std::ceil(size.x()));
  return frame;
}

template <typename Visit>
void ForCellsIn(const Polygon2& region, const EvidenceGrids& grids, Visit&& visit) {
  for (int row = 0; row < grids.frame.rows; ++row) {
    for (int col = 0; col < grids.frame.cols; ++col) {
      if (Contains(region, grids.frame.Center(row, col))) visit(row, col);
    }
  }
}

}  // namespace

EvidenceGrids DrawEvidence(const MultiPolygon2& free, const DrawOptions& options) {
  EvidenceGrids grids;
  grids.frame = FrameOf(free, options);
  const int rows = grids.frame.rows, cols = grids.frame.cols;
  grids.wall = ImageF(rows, cols);
  grids.free = ImageF(rows, cols);
  grids.core = CoreImage(rows, cols);
  const MultiPolygon2 cores = Offset(free, -options.core_distance_m);
  grids.num_cores = static_cast<int>(cores.size());
  std::mt19937 random(options.seed);
  std::normal_distribution<double> gauss;
  const double blur_m = std::max(options.face_blur_m, 0.5 * options.cell_m);
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      const Vector2d p = grids.frame.Center(row, col);
      const double distance = DistanceToRings(free, p);
      const bool is_free = std::any_of(
          free.begin(), free.end(), [&](const Polygon2& polygon) { return Contains(polygon, p); });
      const double sign = is_free ? 1 : distance < options.solid_depth_m ? -1 : 0;
      const double certainty =
          options.face_blur_m > 0 ? std::min(1.0, distance / options.face_blur_m) : 1;
      const double face = std::exp(-0.5 * distance * distance / (blur_m * blur_m));
      const double wall = is_free && distance > 2.5 * blur_m ? -1 : face;
      grids.free(row, col) =
          static_cast<float>(options.log_odds * sign * certainty + options.noise * gauss(random));
      grids.wall(row, col) =
          static_cast<float>(options.log_odds * wall + options.noise * gauss(random));
      for (size_t k = 0; k < cores.size(); ++k) {
        if (Contains(cores[k], p)) grids.core(row, col) = static_cast<uint16_t>(k + 1);
      }
    }
  }
  return grids;
}

EvidenceGrids DrawCounts(const MultiPolygon2& free, const std::vector<Vector2d>& cameras,
                         const DrawOptions& options) {
  EvidenceGrids grids = DrawEvidence(free, options);
  grids.mode = EvidenceMode::kCounts;
  grids.support = ImageU8(grids.frame.rows, grids.frame.cols);
  const MultiPolygon2 passed = Offset(free, -0.05);
  for (int row = 0; row < grids.frame.rows; ++row) {
    for (int col = 0; col < grids.frame.cols; ++col) {
      const Vector2d p = grids.frame.Center(row, col);
      const bool is_passed =
          std::any_of(passed.begin(), passed.end(),
                      [&](const Polygon2& polygon) { return Contains(polygon, p); });
      grids.wall(row, col) = grids.wall(row, col) > 1 ? 7 : 0;
      grids.free(row, col) = is_passed ? 40 : 0;
      grids.support(row, col) = is_passed ? kSupportTwoDirections : 0;
    }
  }
  for (size_t i = 0; i < cameras.size(); ++i)
    grids.cameras.push_back({static_cast<int>(i), cameras[i]});
  return grids;
}

void EraseCore(const Polygon2& region, EvidenceGrids& grids) {
  ForCellsIn(region, grids, [&](int row, int col) { grids.core(row, col) = 0; });
}

void EraseEvidence(const Polygon2& region, EvidenceGrids& grids) {
  ForCellsIn(region, grids,
             [&](int row, int col) { grids.free(row, col) = grids.wall(row, col) = 0; });
}

void AddEvidence(const Polygon2& region, float free, float wall, EvidenceGrids& grids) {
  ForCellsIn(region, grids, [&](int row, int col) {
    grids.free(row, col) += free;
    grids.wall(row, col) += wall;
  });
}

Polygon2 Box(double min_x, double min_y, double max_x, double max_y) {
  return {{{min_x, min_y}, {max_x, min_y}, {max_x, max_y}, {min_x, max_y}}, {}};
}

}  // namespace enfilade
