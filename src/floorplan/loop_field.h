// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "enfilade/evidence/types.h"
#include "enfilade/floorplan/solve.h"
#include "enfilade/image/image.h"
#include "enfilade/optim/grid_loop.h"
#include "src/floorplan/grid_window.h"

namespace enfilade {

/// Costs are counted in millimetres of unseen wall.
inline constexpr double kCostPerMetre = 1000;

/// The evidence of one storey as the loop solver needs it.
struct LoopField {
  GridFrame frame;
  ImageF wall;      ///< log-odds of a wall face
  ImageF freeness;  ///< 1 surely free, 0 unknown, −1 surely solid
  ImageF faceness;  ///< 0 no wall face seen in the cell … 1 one surely seen
  ImageF
      solidity;  ///< log-odds that the cell is solid wall or, where walls are thin, a blurred face
  int turn_cost = 1;
  /// For GridLoopProblem: loops with the room on their left.
  std::vector<uint16_t> step_cost;
};

/// The evidence, which must be in log-odds, without costs.
[[nodiscard]] LoopField NormaliseEvidence(const EvidenceGrids& evidence,
                                          const FloorplanOptions& options);

/// Requires evidence in log-odds.
[[nodiscard]] LoopField MakeLoopField(const EvidenceGrids& evidence,
                                      const FloorplanOptions& options);

/// The part of the field in the window.
[[nodiscard]] LoopField Cropped(const LoopField& field, const GridWindow& window);

/// The costs for loops with the room on their right: every step costs what its reverse did.
[[nodiscard]] std::vector<uint16_t> ReversedStepCosts(const LoopField& field);

/// Blocks the steps whose left cell is set, so that no loop encloses the set cells unless it goes
/// all round a whole 4-connected set of them.
void BlockCells(const ImageU8& cells, GridLoopProblem& problem);

}  // namespace enfilade
