// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/edge_cost.h"

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

using Eigen::Vector2d;

float At(const GridFrame& frame, const ImageF& image, const Vector2d& p) {
  const int row = frame.Row(p.y()), col = frame.Col(p.x());
  return frame.IsInside(row, col) ? image(row, col) : 0;
}

float FaceAt(const LoopField& field, const Vector2d& left, const Vector2d& right) {
  return std::max(At(field.frame, field.faceness, left), At(field.frame, field.faceness, right));
}

// Metres of free space met on `num_steps` steps from p, until a wall stops the view.
double FreeDepth(const LoopField& field, Vector2d p, const Vector2d& step, int num_steps) {
  float depth = 0, passed = 1;
  for (int k = 0; k < num_steps && passed > 0.05F; ++k, p += step) {
    const float free = At(field.frame, field.freeness, p);
    depth += passed * std::max(free, 0.0F);
    passed *= 1 - std::max(std::max(-free, 0.0F), At(field.frame, field.faceness, p));
  }
  return depth * step.norm();
}

// Metres of solid wall met on `num_steps` steps from p.
double SolidDepth(const LoopField& field, Vector2d p, const Vector2d& step, int num_steps) {
  float depth = 0;
  for (int k = 0; k < num_steps; ++k, p += step)
    depth += std::max(-At(field.frame, field.freeness, p), 0.0F);
  return depth * step.norm();
}

// Calls visit(left, right, left_step) in the middle of equal pieces of about a cell's length:
// points half a cell to either side, and the step of one cell to the left.
template <typename Visit>
int ForPieces(const LoopField& field, const Vector2d& a, const Vector2d& b, const Visit& visit) {
  const double cell_m = field.frame.cell_m, length_m = (b - a).norm();
  const int num_pieces = std::max(1, static_cast<int>(std::lround(length_m / cell_m)));
  const Vector2d left_step = cell_m / length_m * Vector2d(a.y() - b.y(), b.x() - a.x());
  for (int k = 0; k < num_pieces; ++k) {
    const Vector2d p = a + (k + 0.5) / num_pieces * (b - a);
    visit(p + 0.5 * left_step, p - 0.5 * left_step, left_step);
  }
  return num_pieces;
}

}  // namespace

EdgeTerms MeasureEdge(const LoopField& field, const FloorplanOptions& options, const Vector2d& a,
                      const Vector2d& b) {
  const int depth =
      std::max(1, static_cast<int>(std::lround(options.free_depth_m / field.frame.cell_m)));
  EdgeTerms sum;
  const int num_pieces = ForPieces(
      field, a, b, [&](const Vector2d& left, const Vector2d& right, const Vector2d& step) {
        sum.unseen_m += 1 - FaceAt(field, left, right);
        sum.free_outside_m2 += FreeDepth(field, right, -step, depth);
        sum.solid_inside_m2 += SolidDepth(field, left, step, depth);
      });
  const double piece_m = (b - a).norm() / num_pieces;
  return {sum.unseen_m * piece_m, sum.free_outside_m2 * piece_m, sum.solid_inside_m2 * piece_m};
}

double CostOf(const EdgeTerms& terms, const FloorplanOptions& options) {
  return terms.unseen_m + options.outside_weight * terms.free_outside_m2 +
         options.inside_weight * terms.solid_inside_m2;
}

double EdgeCost(const LoopField& field, const FloorplanOptions& options, const Vector2d& a,
                const Vector2d& b) {
  return CostOf(MeasureEdge(field, options, a, b), options);
}

double SeenShare(const LoopField& field, const Vector2d& a, const Vector2d& b) {
  double sum = 0;
  const int num_pieces =
      ForPieces(field, a, b, [&](const Vector2d& left, const Vector2d& right, const Vector2d&) {
        sum += FaceAt(field, left, right);
      });
  return sum / num_pieces;
}

}  // namespace enfilade
