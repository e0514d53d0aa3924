// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/coverage.h"

#include <array>
#include <limits>

#include "enfilade/evaluate/walls.h"
#include "src/evaluate/statistics.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct Tally {
  int num_walls = 0, within1 = 0, within2 = 0;

  void Add(double error_m, double sigma_m) {
    ++num_walls;
    within1 += error_m <= sigma_m;
    within2 += error_m <= 2 * sigma_m;
  }
  [[nodiscard]] Coverage Shares() const {
    if (num_walls == 0) return {};
    const double total = num_walls;
    return {num_walls, within1 / total, within2 / total};
  }
};

std::vector<Segment2> ToHome(const Rigid3& home_from_world, std::vector<Segment2> walls) {
  for (Segment2& wall : walls) {
    for (Vector2d& p : wall) p = (home_from_world * Vector3d(p.x(), p.y(), 0)).head<2>();
  }
  return walls;
}

std::vector<Segment2> PassableOpenings(const Storey& storey) {
  std::vector<Segment2> gaps;
  for (const Opening& opening : storey.openings) {
    if (opening.kind != OpeningKind::kWindow && opening.a != opening.b) {
      gaps.push_back({opening.a, opening.b});
    }
  }
  return gaps;
}

}  // namespace

CoverageFigures EvaluateCoverage(const Floorplan& floorplan, const JudgedPlan& truth) {
  if (truth.walls.empty()) return {};
  const std::vector<Segment2> true_walls = ToHome(floorplan.home_from_world, truth.walls);
  Tally all;
  std::array<Tally, 3> by_seen;
  for (const Storey& storey : floorplan.storeys) {
    const std::vector<Segment2> gaps = PassableOpenings(storey);
    for (const Wall& wall : storey.walls) {
      if (!(wall.sigma_m > 0) || wall.a == wall.b) continue;
      const std::vector<double> distances =
          WallDistances(CutOpenings({{wall.a, wall.b}}, gaps), true_walls);
      if (distances.empty()) continue;
      const double error_m = Median(distances).value_or(std::numeric_limits<double>::infinity());
      all.Add(error_m, wall.sigma_m);
      by_seen.at(static_cast<size_t>(wall.seen)).Add(error_m, wall.sigma_m);
    }
  }
  return {all.Shares(), by_seen[0].Shares(), by_seen[1].Shares(), by_seen[2].Shares()};
}

}  // namespace enfilade
