// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "enfilade/image/distance_transform.h"

namespace enfilade {
namespace {

constexpr double kTrim_m = 0.1;
constexpr double kIslandMargin_m = 0.5;

int MarginCells(const GridFrame& frame, const FloorplanOptions& options) {
  return static_cast<int>(std::lround(options.margin_m / frame.cell_m));
}

int IslandMargin(const GridFrame& frame) {
  return static_cast<int>(std::lround(kIslandMargin_m / frame.cell_m));
}

/// From the window's vertices to the grid's.
void Shift(const GridWindow& window, std::vector<GridVertex>& ring) {
  for (GridVertex& vertex : ring) vertex = {vertex.row + window.row, vertex.col + window.col};
}

GridLoopProblem MakeProblem(const LoopField& field, std::vector<uint16_t> step_cost,
                            const ImageU8& core, const FloorplanOptions& options) {
  GridLoopProblem problem;
  problem.rows = field.frame.rows;
  problem.cols = field.frame.cols;
  problem.core = core.data();
  problem.step_cost = std::move(step_cost);
  problem.turn_cost = field.turn_cost;
  problem.margin_cells = MarginCells(field.frame, options);
  return problem;
}

/// Cells at least kTrim_m away from everything outside.
ImageU8 Deep(const ImageU8& inside, double cell_m) {
  ImageU8 outside = inside;
  for (uint8_t& cell : outside.data()) cell ^= 1;
  const ImageF distance = DistanceToMask(outside);
  ImageU8 deep(inside.rows(), inside.cols());
  for (size_t i = 0; i < deep.data().size(); ++i) {
    deep.data()[i] = distance.data()[i] * static_cast<float>(cell_m) > static_cast<float>(kTrim_m);
  }
  return deep;
}

/// Solid wall that lies deep inside the ring though it is too large for an error of the evidence.
/// Near the ring the faces of its own walls look solid.
std::vector<CellSet> EnclosedSolids(const LoopField& field, const ImageU8& inside,
                                    const ImageU8& core, const FloorplanOptions& options) {
  const int cols = field.frame.cols;
  ImageU8 solid = Deep(inside, field.frame.cell_m);
  const auto threshold = static_cast<float>(options.solid_log_odds);
  for (size_t i = 0; i < solid.data().size(); ++i) {
    solid.data()[i] &=
        static_cast<uint8_t>(field.solidity.data()[i] >= threshold && core.data()[i] == 0);
  }
  std::vector<CellSet> sets = ConnectedCells(solid);
  std::erase_if(sets, [&](const CellSet& set) {
    int first_col = cols, last_col = 0;
    for (const int cell : set) {
      first_col = std::min(first_col, cell % cols);
      last_col = std::max(last_col, cell % cols);
    }
    const int extent = std::max(last_col - first_col, set.back() / cols - set.front() / cols) + 1;
    const double cell_m = field.frame.cell_m;
    return static_cast<double>(set.size()) * cell_m * cell_m < options.min_solid_area_m2 ||
           extent * cell_m < options.min_solid_length_m;
  });
  return sets;
}

/// Ways from the border of the field that shun free space, to learn what hangs together with the
/// outside: one metre of free space is as far as a hundred of anything else.
CellWays WaysFromOutside(const LoopField& field, const ImageU8& core) {
  const int rows = field.frame.rows, cols = field.frame.cols;
  ImageF cost(rows, cols);
  ImageI source(rows, cols, 1, -1);
  for (size_t i = 0; i < cost.data().size(); ++i) {
    cost.data()[i] = core.data()[i] != 0 ? -1 : 0.01F + std::max(field.freeness.data()[i], 0.0F);
  }
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      if (row == 0 || col == 0 || row + 1 == rows || col + 1 == cols) source(row, col) = 0;
    }
  }
  return FindCellWays(cost, std::move(source));
}

/// The way from the outside to the nearest cell of a solid, and the free space inside the ring that
/// it crosses: without end where the core lies all round.
struct Bridge {
  std::vector<int> cells;
  double free_m = 0;
};

Bridge FindBridge(const LoopField& field, const CellWays& ways, const CellSet& solid,
                  const std::vector<uint8_t>& is_inside) {
  const auto nearest = std::min_element(solid.begin(), solid.end(), [&](int a, int b) {
    return ways.cost.data()[static_cast<size_t>(a)] < ways.cost.data()[static_cast<size_t>(b)];
  });
  Bridge bridge;
  if (std::isinf(ways.cost.data()[static_cast<size_t>(*nearest)])) {
    bridge.free_m = std::numeric_limits<double>::infinity();
    return bridge;
  }
  for (int cell = *nearest; cell >= 0; cell = ways.parent.data()[static_cast<size_t>(cell)]) {
    bridge.cells.push_back(cell);
    const auto i = static_cast<size_t>(cell);
    if (is_inside[i] != 0)
      bridge.free_m += field.frame.cell_m * std::max(field.freeness.data()[i], 0.0F);
  }
  return bridge;
}

/// A loop round a solid: the room lies outside of it and must stay there. Accepted where evidence
/// carries it.
std::vector<GridVertex> FindIsland(const LoopField& field, const CellSet& solid,
                                   const ImageU8& core, const FloorplanOptions& options,
                                   GridOutline& outline) {
  const int margin = IslandMargin(field.frame), cols = field.frame.cols;
  GridWindow window;
  for (const int cell : solid) window.Add(cell / cols, cell % cols);
  // One cell more: the loop along the border looks at the cells beside it.
  window = window.Grown(margin + 1, field.frame.rows, cols);
  const LoopField part = Cropped(field, window);
  ImageU8 cells(window.rows, window.cols);
  for (const int cell : solid) cells(cell / cols - window.row, cell % cols - window.col) = 1;
  GridLoopProblem problem = MakeProblem(part, ReversedStepCosts(part), cells, options);
  problem.margin_cells = margin;
  BlockCells(Cropped(core, window), problem);
  GridLoopReport report = FindShortestLoop(problem);
  outline.num_settled += report.num_settled;
  if (report.outcome != GridLoopOutcome::kFound) return {};
  int64_t length = 0;
  for (size_t i = 0; i < report.ring.size(); ++i) {
    const GridVertex& a = report.ring[i];
    const GridVertex& b = report.ring[(i + 1) % report.ring.size()];
    length += std::abs(a.row - b.row) + std::abs(a.col - b.col);
  }
  const double turns = static_cast<double>(report.ring.size()) * problem.turn_cost;
  const double rate = (static_cast<double>(report.cost) - turns) /
                      (kCostPerMetre * field.frame.cell_m * static_cast<double>(length));
  if (rate > options.max_island_cost) return {};
  Shift(window, report.ring);
  return std::move(report.ring);
}

GridOutline FindOutline(const LoopField& field, const ImageU8& core, const ImageU8& foreign,
                        const FloorplanOptions& options, RunContext& context) {
  GridOutline outline;
  GridLoopProblem problem = MakeProblem(field, field.step_cost, core, options);
  BlockCells(foreign, problem);
  GridLoopReport report = FindShortestLoop(problem);
  outline.outcome = report.outcome;
  outline.num_settled = report.num_settled;
  if (report.outcome != GridLoopOutcome::kFound) return outline;
  outline.outer = std::move(report.ring);
  context.CheckStop();

  const ImageU8 inside = CellsInside(field.frame.rows, field.frame.cols, outline.outer);
  std::vector<CellSet> solids = EnclosedSolids(field, inside, core, options);
  if (solids.empty()) return outline;
  const CellWays ways = WaysFromOutside(field, core);
  ImageU8 walls = foreign;
  std::vector<CellSet> free_standing;
  for (CellSet& solid : solids) {
    const Bridge bridge = FindBridge(field, ways, solid, inside.data());
    if (bridge.free_m > options.max_bridge_m) {
      free_standing.push_back(std::move(solid));
      continue;
    }
    ++outline.num_inner_walls;
    for (const int cell : solid) walls.data()[static_cast<size_t>(cell)] = 1;
    for (const int cell : bridge.cells) walls.data()[static_cast<size_t>(cell)] = 1;
  }
  if (outline.num_inner_walls > 0) {
    BlockCells(walls, problem);
    report = FindShortestLoop(problem);
    outline.num_settled += report.num_settled;
    if (report.outcome == GridLoopOutcome::kFound) {
      outline.outer = std::move(report.ring);
    } else {
      outline.num_inner_walls = 0;
    }
  }
  for (const CellSet& solid : free_standing) {
    context.CheckStop();
    std::vector<GridVertex> island = FindIsland(field, solid, core, options, outline);
    if (!island.empty()) outline.islands.push_back(std::move(island));
  }
  return outline;
}

}  // namespace

GridOutline FindOutline(const LoopField& field, const CoreMap& cores, const ImageI& territories,
                        int core_idx, const FloorplanOptions& options, RunContext& context) {
  // So far the loop may go, and islands in it beyond.
  const int reach = MarginCells(field.frame, options) + IslandMargin(field.frame) + 1;
  const GridWindow window =
      cores.windows[static_cast<size_t>(core_idx)].Grown(reach, field.frame.rows, field.frame.cols);
  const ImageU8 core = CellsWhere(Cropped(cores.core_of_cell, window),
                                  [&](int at_cell) { return at_cell == core_idx; });
  GridOutline outline =
      FindOutline(Cropped(field, window), core,
                  ForeignCells(Cropped(territories, window), core_idx), options, context);
  Shift(window, outline.outer);
  for (std::vector<GridVertex>& island : outline.islands) Shift(window, island);
  return outline;
}

}  // namespace enfilade
