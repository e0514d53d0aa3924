// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/loop_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "enfilade/base/check.h"
#include "src/floorplan/grid_steps.h"

namespace enfilade {
namespace {

float At(const ImageF& image, int row, int col) {
  const bool is_inside = row >= 0 && col >= 0 && row < image.rows() && col < image.cols();
  return is_inside ? image(row, col) : 0;
}

/// Metres of free space met when walking from a cell outwards, until a wall stops the view.
float FreeDepth(const LoopField& field, int row, int col, int heading, int num_cells) {
  float depth = 0, passed = 1;
  for (int k = 0; k < num_cells && passed > 0.05F; ++k) {
    const float free = At(field.freeness, row, col);
    depth += passed * std::max(free, 0.0F);
    passed *= 1 - std::max(std::max(-free, 0.0F), At(field.faceness, row, col));
    row += kRowStep[heading];
    col += kColStep[heading];
  }
  return depth * static_cast<float>(field.frame.cell_m);
}

/// Metres of solid wall met when walking from a cell into the room.
float SolidDepth(const LoopField& field, int row, int col, int heading, int num_cells) {
  float depth = 0;
  for (int k = 0; k < num_cells; ++k) {
    depth += std::max(-At(field.freeness, row, col), 0.0F);
    row += kRowStep[heading];
    col += kColStep[heading];
  }
  return depth * static_cast<float>(field.frame.cell_m);
}

uint16_t ToUnits(double cost_m) {
  return static_cast<uint16_t>(std::clamp(std::lround(cost_m * kCostPerMetre), 0L, 60000L));
}

void NormaliseLogOdds(const EvidenceGrids& evidence, const FloorplanOptions& options,
                      LoopField& field) {
  for (size_t i = 0; i < evidence.wall.data().size(); ++i) {
    const float wall = evidence.wall.data()[i], free = evidence.free.data()[i];
    field.freeness.data()[i] = std::tanh(0.5F * free);
    // No face stands where panoramas look through.
    field.faceness.data()[i] =
        std::clamp(wall / static_cast<float>(options.seen_wall_log_odds), 0.0F, 1.0F) *
        (1 - std::max(field.freeness.data()[i], 0.0F));
    field.solidity.data()[i] = static_cast<float>(options.wall_share) * std::max(wall, 0.0F) - free;
  }
}

}  // namespace

LoopField NormaliseEvidence(const EvidenceGrids& evidence, const FloorplanOptions& options) {
  ENFILADE_CHECK(evidence.mode == EvidenceMode::kLogOdds);
  LoopField field;
  field.frame = evidence.frame;
  const int rows = field.frame.rows, cols = field.frame.cols;
  field.wall = evidence.wall;
  field.freeness = ImageF(rows, cols);
  field.faceness = ImageF(rows, cols);
  field.solidity = ImageF(rows, cols);
  NormaliseLogOdds(evidence, options, field);
  return field;
}

LoopField MakeLoopField(const EvidenceGrids& evidence, const FloorplanOptions& options) {
  LoopField field = NormaliseEvidence(evidence, options);
  const int rows = field.frame.rows, cols = field.frame.cols;
  field.turn_cost = std::max(1, static_cast<int>(std::lround(options.turn_cost_m * kCostPerMetre)));

  GridLoopProblem layout;
  layout.rows = rows;
  layout.cols = cols;
  field.step_cost.assign(layout.StepIndex(rows + 1, 0, GridHeading::kEast), 0);
  const double cell_m = field.frame.cell_m;
  const int depth = std::max(1, static_cast<int>(std::lround(options.free_depth_m / cell_m)));
  for (int row = 0; row <= rows; ++row) {
    for (int col = 0; col <= cols; ++col) {
      for (int heading = 0; heading < 4; ++heading) {
        const GridVertex left = LeftCell({row, col}, static_cast<GridHeading>(heading));
        const GridVertex right = RightCell({row, col}, static_cast<GridHeading>(heading));
        const float face = std::max(At(field.faceness, left.row, left.col),
                                    At(field.faceness, right.row, right.col));
        const int outwards = (heading + 3) & 3, inwards = (heading + 1) & 3;
        const double rate =
            1 - face +
            options.outside_weight * FreeDepth(field, right.row, right.col, outwards, depth) +
            options.inside_weight * SolidDepth(field, left.row, left.col, inwards, depth);
        field.step_cost[layout.StepIndex(row, col, static_cast<GridHeading>(heading))] =
            ToUnits(rate * cell_m);
      }
    }
  }
  return field;
}

std::vector<uint16_t> ReversedStepCosts(const LoopField& field) {
  GridLoopProblem layout;
  layout.rows = field.frame.rows;
  layout.cols = field.frame.cols;
  std::vector<uint16_t> reversed(field.step_cost.size(), kBlockedStep);
  for (int row = 0; row <= layout.rows; ++row) {
    for (int col = 0; col <= layout.cols; ++col) {
      for (int heading = 0; heading < 4; ++heading) {
        const int to_row = row + kRowStep[heading], to_col = col + kColStep[heading];
        if (to_row < 0 || to_col < 0 || to_row > layout.rows || to_col > layout.cols) continue;
        reversed[layout.StepIndex(row, col, static_cast<GridHeading>(heading))] =
            field
                .step_cost[layout.StepIndex(to_row, to_col, static_cast<GridHeading>(heading ^ 2))];
      }
    }
  }
  return reversed;
}

void BlockCells(const ImageU8& cells, GridLoopProblem& problem) {
  for (int row = 0; row < problem.rows; ++row) {
    for (int col = 0; col < problem.cols; ++col) {
      if (cells(row, col) == 0) continue;
      for (int heading = 0; heading < 4; ++heading) {
        // The vertex from which a step with this heading has the cell on its left.
        const auto direction = static_cast<GridHeading>(heading);
        const GridVertex offset = LeftCell({0, 0}, direction);
        problem.step_cost[problem.StepIndex(row - offset.row, col - offset.col, direction)] =
            kBlockedStep;
      }
    }
  }
}

}  // namespace enfilade
