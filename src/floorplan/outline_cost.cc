// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/outline_cost.h"

#include "src/floorplan/edge_cost.h"

namespace enfilade {

void AddEdgeCost(const LoopField& field, const FloorplanOptions& options, const Eigen::Vector2d& a,
                 const Eigen::Vector2d& b, OutlineCost& cost) {
  if (a == b) return;
  const EdgeTerms terms = MeasureEdge(field, options, a, b);
  cost.length_m += (b - a).norm();
  cost.unseen_m += terms.unseen_m;
  cost.free_outside_m2 += terms.free_outside_m2;
  cost.solid_inside_m2 += terms.solid_inside_m2;
  cost.total_m += CostOf(terms, options);
}

void AddCornerCosts(const FloorplanOptions& options, int num_corners, OutlineCost& cost) {
  cost.num_corners += num_corners;
  cost.total_m += num_corners * options.turn_cost_m;
}

}  // namespace enfilade
