// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/paper_walls.h"

#include <algorithm>
#include <cmath>

#include "src/floorplan/rooms.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kReach_m = 0.1;  // of points beside the wall

struct EdgeEvidence {
  double seen_share = 0;
  double scatter_m = 0;
};

EdgeEvidence MeasureEdge(const PaperField& field, const Vector2d& a, const Vector2d& b) {
  const GridFrame& frame = field.frame;
  const double length = (b - a).norm(), cell_m = frame.cell_m;
  const Vector2d direction = (b - a) / length, normal(-direction.y(), direction.x());
  const int num_along = std::max(1, static_cast<int>(std::lround(length / cell_m)));
  const int reach = std::max(1, static_cast<int>(std::lround(kReach_m / cell_m)));
  int num_seen = 0;
  double sum = 0, moment = 0, second_moment = 0;
  for (int k = 0; k < num_along; ++k) {
    const Vector2d p = a + (k + 0.5) / num_along * length * direction;
    bool is_seen = false;
    for (int t = -reach; t < reach; ++t) {
      const double offset = (t + 0.5) * cell_m;
      const Vector2d q = p + offset * normal;
      const int row = frame.Row(q.y()), col = frame.Col(q.x());
      if (!frame.IsInside(row, col)) continue;
      const double points = field.wall(row, col);
      sum += points;
      moment += points * offset;
      second_moment += points * offset * offset;
      is_seen = is_seen || ((t == 0 || t == -1) && field.IsSeen(row, col));
    }
    num_seen += is_seen;
  }
  EdgeEvidence evidence{static_cast<double>(num_seen) / num_along, 0};
  if (sum > 0) {
    const double mean = moment / sum;
    evidence.scatter_m = std::sqrt(std::max(0.0, second_moment / sum - mean * mean));
  }
  return evidence;
}

}  // namespace

OutlineChoice MeasureOutline(const PaperField& field, const Polygon2& polygon, double cost_m) {
  OutlineChoice outline{cost_m, polygon, {}, {}};
  for (const Ring2& ring : RingsOf(polygon)) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const EdgeEvidence evidence = MeasureEdge(field, ring[i], ring[(i + 1) % ring.size()]);
      const WallSeen seen = SeenOf(evidence.seen_share);
      outline.seen.push_back(seen);
      // On the grid a wall is known to a cell at best.
      const double sigma_m = seen == WallSeen::kInferred
                                 ? kInferredSigma_m
                                 : std::max(evidence.scatter_m, 0.5 * field.frame.cell_m);
      // To the millimetre, so that a plan read from a file gives the same area_sigma_m2.
      outline.sigma_m.push_back(std::max(0.001, std::round(sigma_m * 1000) / 1000));
    }
  }
  return outline;
}

}  // namespace enfilade
