// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "enfilade/evidence/types.h"
#include "enfilade/floorplan/paper.h"
#include "enfilade/image/image.h"
#include "enfilade/optim/grid_loop.h"

namespace enfilade {

/// Costs of the paper's method are counted in this part of a cell of unseen wall.
inline constexpr int kCostPerCell = 20;

/// Raw counts of one storey and what the path pays for them.
struct PaperField {
  GridFrame frame;
  ImageF wall;            ///< points in the cell
  ImageF rays;            ///< rays across the cell
  ImageU8 is_sure;        ///< free space that may be believed to lie inside the home
  float seen_points = 1;  ///< from which the wall in a cell counts as seen
  int turn_cost = 1;
  /// For GridLoopProblem: the same for every heading.
  std::vector<uint16_t> step_cost;

  [[nodiscard]] bool IsSeen(int row, int col) const { return wall(row, col) >= seen_points; }
  /// Rays pass here, more than end here.
  [[nodiscard]] bool IsFree(int row, int col) const {
    return rays(row, col) >= 1 && rays(row, col) > wall(row, col);
  }
  [[nodiscard]] double ToMetres(int64_t cost) const {
    return static_cast<double>(cost) / kCostPerCell * frame.cell_m;
  }
};

/// Requires raw counts; values that are no numbers count as none.
[[nodiscard]] PaperField MakePaperField(const EvidenceGrids& evidence, const PaperOptions& options);

/// A problem with the field's costs, the core to go round, and cells that may not be enclosed.
[[nodiscard]] GridLoopProblem MakePaperProblem(const PaperField& field, const ImageU8& core,
                                               const ImageU8& foreign, double margin_m);

}  // namespace enfilade
