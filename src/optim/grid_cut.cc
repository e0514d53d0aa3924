// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/optim/grid_cut.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "enfilade/base/check.h"

namespace enfilade {
namespace {

enum class Tree : uint8_t { kSource, kSink, kNone };

// Directions are +col, −col, +row, −row, +layer, −layer; the opposite of d is d ^ 1. A cell's
// parent is one of them or:
constexpr uint8_t kTerminal = 6;  // the cell hangs on source or sink itself
constexpr uint8_t kOrphan = 7;    // it was cut off and waits for a new parent

template <int kNumDirections>
struct Cell {
  // What may still flow to the neighbour in each direction.
  std::array<int32_t, kNumDirections> residual{};
  int32_t excess = 0;  // residual from the source, or minus that to the sink
  int32_t level = 0;   // steps to the terminal along the tree
  Tree tree = Tree::kNone;
  uint8_t parent = kOrphan;
};

// Two trees of cells, one of what the source reaches through edges with residual capacity, one of
// what reaches the sink. Both are breadth-first: no residual edge leads over more than one level
// upwards, and all cells below the last level have taken in their neighbours. They grow level by
// level in turn. Where they touch, flow along the path through both saturates edges; what hung on
// these looks for new parents at the lowest level there is. A tree without a last level has grown
// to its end, and no path is left.
//
// Four directions for grids of one layer, six for all.
template <int kNumDirections>
class TwoTrees {
 public:
  explicit TwoTrees(const GridCutProblem& problem)
      : rows_(problem.rows),
        cols_(problem.cols),
        layers_(problem.layers),
        cells_(NumFramedCells(problem)) {
    const int32_t row_step = problem.cols + 2, layer_step = (problem.rows + 2) * row_step;
    const std::array<int32_t, 6> steps = {1, -1, row_step, -row_step, layer_step, -layer_step};
    std::copy_n(steps.begin(), kNumDirections, step_.begin());
    ForEachCell([&](int row, int col, int layer) { SetCapacities(problem, row, col, layer); });
    ForEachCell([&](int row, int col, int layer) { Root(IndexOf(row, col, layer)); });
  }

  [[nodiscard]] static size_t NumFramedCells(const GridCutProblem& problem) {
    const size_t num_layers = static_cast<size_t>(problem.layers) + 2 * kLayerFrame;
    return num_layers * static_cast<size_t>(problem.rows + 2) *
           static_cast<size_t>(problem.cols + 2);
  }

  void Saturate() {
    while (!front_[0].cells.empty() && !front_[1].cells.empty()) {
      const bool is_source_smaller = front_[0].cells.size() <= front_[1].cells.size();
      GrowLevel(is_source_smaller ? Tree::kSource : Tree::kSink);
    }
  }

  // What the source still reaches is the smallest source side.
  [[nodiscard]] GridCutReport TakeReport() {
    MarkReached();
    report_.is_source.reserve(static_cast<size_t>(layers_) * static_cast<size_t>(rows_) *
                              static_cast<size_t>(cols_));
    ForEachCell([&](int row, int col, int layer) {
      report_.is_source.push_back(At(IndexOf(row, col, layer)).tree == Tree::kSource);
    });
    return std::move(report_);
  }

 private:
  using Cell = enfilade::Cell<kNumDirections>;
  // Layers of the frame on each side.
  static constexpr int kLayerFrame = kNumDirections == 6 ? 1 : 0;

  // The last level of a tree, whose cells have not taken in their neighbours. Lists may hold cells
  // that are no longer there.
  struct Front {
    int32_t level = 1;
    int32_t highest = 1;  // that a cell may have: one more while the tree grows
    std::vector<int32_t> cells;
    std::vector<int32_t> next;  // those of level + 1
  };

  // A frame of cells without capacities lies round the grid, so that no step needs a check.
  [[nodiscard]] int32_t IndexOf(int row, int col, int layer) const {
    return ((layer + kLayerFrame) * (rows_ + 2) + row + 1) * (cols_ + 2) + col + 1;
  }
  template <typename Visit>
  void ForEachCell(Visit&& visit) const {
    for (int layer = 0; layer < layers_; ++layer) {
      for (int row = 0; row < rows_; ++row) {
        for (int col = 0; col < cols_; ++col) visit(row, col, layer);
      }
    }
  }
  [[nodiscard]] Cell& At(int32_t cell) { return cells_[static_cast<size_t>(cell)]; }
  [[nodiscard]] int32_t Neighbor(int32_t cell, int direction) const {
    return cell + step_[static_cast<size_t>(direction)];
  }
  [[nodiscard]] Front& FrontOf(Tree tree) { return front_[static_cast<size_t>(tree)]; }
  // Room for flow from a cell to its neighbour.
  [[nodiscard]] int32_t& Residual(int32_t cell, int direction) {
    return At(cell).residual[static_cast<size_t>(direction)];
  }
  // Room for flow between a cell and its neighbour, the way that flow takes in the tree where the
  // neighbour is the child: away from the source, towards the sink.
  [[nodiscard]] int32_t RoomToChild(Tree tree, int32_t cell, int direction) {
    return tree == Tree::kSource ? Residual(cell, direction)
                                 : Residual(Neighbor(cell, direction), direction ^ 1);
  }

  void SetCapacities(const GridCutProblem& problem, int row, int col, int layer) {
    const size_t i = problem.Index(row, col, layer);
    const int32_t cell = IndexOf(row, col, layer);
    At(cell).excess = problem.source_capacity[i] - problem.sink_capacity[i];
    report_.cost += std::min(problem.source_capacity[i], problem.sink_capacity[i]);
    if (col + 1 < cols_) Connect(cell, 0, problem.east_capacity[i]);
    if (row + 1 < rows_) Connect(cell, 2, problem.north_capacity[i]);
    if constexpr (kNumDirections == 6) {
      if (layer + 1 < layers_) Connect(cell, 4, problem.up_capacity[i]);
    }
  }
  void Connect(int32_t cell, int direction, int32_t capacity) {
    Residual(cell, direction) = Residual(Neighbor(cell, direction), direction ^ 1) = capacity;
  }

  void Root(int32_t cell) {
    Cell& root = At(cell);
    if (root.excess == 0) return;
    root.tree = root.excess > 0 ? Tree::kSource : Tree::kSink;
    root.parent = kTerminal;
    root.level = 1;
    FrontOf(root.tree).cells.push_back(cell);
  }

  void GrowLevel(Tree tree) {
    Front& front = FrontOf(tree);
    front.highest = front.level + 1;
    // Cells may come to this level while it is passed through.
    for (size_t i = 0; i < front.cells.size(); ++i) Scan(front.cells[i], tree);
    ++front.level;
    front.cells.swap(front.next);
    front.next.clear();
  }

  // Takes in the free neighbours of a cell and sends flow to those of the other tree.
  void Scan(int32_t cell, Tree tree) {
    const int32_t level = FrontOf(tree).level;
    for (int d = 0; d < kNumDirections;) {
      if (At(cell).tree != tree || At(cell).level != level) return;
      const int32_t next = Neighbor(cell, d);
      if (RoomToChild(tree, cell, d) <= 0 || At(next).tree == tree) {
        ++d;
      } else if (At(next).tree == Tree::kNone) {
        HangOn(next, d ^ 1, tree);
        ++d;
      } else if (tree == Tree::kSource) {
        Augment(cell, d);
      } else {
        Augment(next, d ^ 1);
      }
    }
  }

  void HangOn(int32_t cell, int direction, Tree tree) {
    Front& front = FrontOf(tree);
    Cell& child = At(cell);
    child.tree = tree;
    child.parent = static_cast<uint8_t>(direction);
    child.level = At(Neighbor(cell, direction)).level + 1;
    if (child.level == front.level) front.cells.push_back(cell);
    if (child.level == front.level + 1) front.next.push_back(cell);
  }

  // Sends flow from the source's tree through a cell and its neighbour to the sink.
  void Augment(int32_t cell, int direction) {
    const int32_t next = Neighbor(cell, direction);
    const int32_t flow = std::min({Residual(cell, direction), RoomToRoot(cell), RoomToRoot(next)});
    Residual(cell, direction) -= flow;
    Residual(next, direction ^ 1) += flow;
    report_.cost += flow;
    ++report_.num_augmentations;
    for (const int32_t end : {cell, next}) {
      const Tree tree = At(end).tree;
      PushToRoot(end, flow);
      // Lower levels first: they are the parents of others.
      std::reverse(orphans_.begin(), orphans_.end());
      for (size_t i = 0; i < orphans_.size(); ++i) Adopt(orphans_[i], tree);
      orphans_.clear();
    }
  }

  // The least residual between a cell and its terminal.
  [[nodiscard]] int32_t RoomToRoot(int32_t cell) {
    const Tree tree = At(cell).tree;
    int32_t room = std::numeric_limits<int32_t>::max();
    for (; At(cell).parent != kTerminal; cell = Neighbor(cell, At(cell).parent)) {
      const int to_parent = At(cell).parent;
      room = std::min(room, RoomToChild(tree, Neighbor(cell, to_parent), to_parent ^ 1));
    }
    const int32_t excess = At(cell).excess;
    return std::min(room, tree == Tree::kSource ? excess : -excess);
  }

  void PushToRoot(int32_t cell, int32_t flow) {
    const bool is_source = At(cell).tree == Tree::kSource;
    while (At(cell).parent != kTerminal) {
      const int to_parent = At(cell).parent;
      const int32_t parent = Neighbor(cell, to_parent);
      int32_t& upwards = Residual(cell, to_parent);
      int32_t& downwards = Residual(parent, to_parent ^ 1);
      (is_source ? downwards : upwards) -= flow;
      (is_source ? upwards : downwards) += flow;
      if ((is_source ? downwards : upwards) == 0) Orphan(cell);
      cell = parent;
    }
    At(cell).excess += is_source ? -flow : flow;
    if (At(cell).excess == 0) Orphan(cell);
  }

  void Orphan(int32_t cell) {
    At(cell).parent = kOrphan;
    orphans_.push_back(cell);
  }

  // Hangs an orphan on the neighbour at the lowest level. Where that is no longer the level it had,
  // and where there is none so that it leaves the tree, its children become orphans.
  void Adopt(int32_t cell, Tree tree) {
    const int32_t old_level = At(cell).level;
    int32_t level = FrontOf(tree).highest;
    int parent = -1;
    for (int d = 0; d < kNumDirections; ++d) {
      const int32_t next = Neighbor(cell, d);
      if (At(next).tree != tree || At(next).level >= level) continue;
      if (RoomToChild(tree, next, d ^ 1) <= 0) continue;
      level = At(next).level;
      parent = d;
      if (level + 1 == old_level) break;
    }
    if (parent < 0 || level + 1 != old_level) {
      for (int d = 0; d < kNumDirections; ++d) {
        const int32_t next = Neighbor(cell, d);
        if (At(next).tree == tree && At(next).parent == (d ^ 1)) Orphan(next);
      }
    }
    if (parent >= 0) {
      HangOn(cell, parent, tree);
    } else {
      At(cell).tree = Tree::kNone;
      At(cell).parent = kOrphan;
    }
  }

  // Leaves in the source's tree all that residual edges lead to from the source, and nothing else.
  void MarkReached() {
    std::vector<int32_t> reached;
    for (int32_t cell = 0; cell < static_cast<int32_t>(cells_.size()); ++cell) {
      const bool is_root = At(cell).excess > 0;
      At(cell).tree = is_root ? Tree::kSource : Tree::kNone;
      if (is_root) reached.push_back(cell);
    }
    while (!reached.empty()) {
      const int32_t cell = reached.back();
      reached.pop_back();
      for (int d = 0; d < kNumDirections; ++d) {
        Cell& next = At(Neighbor(cell, d));
        if (Residual(cell, d) <= 0 || next.tree == Tree::kSource) continue;
        next.tree = Tree::kSource;
        reached.push_back(Neighbor(cell, d));
      }
    }
  }

  const int rows_, cols_, layers_;
  std::array<int32_t, kNumDirections> step_{};
  std::vector<Cell> cells_;
  std::vector<int32_t> orphans_;
  std::array<Front, 2> front_;
  GridCutReport report_;
};

template <int kNumDirections>
GridCutReport FindCutIn(const GridCutProblem& problem) {
  TwoTrees<kNumDirections> trees(problem);
  trees.Saturate();
  return trees.TakeReport();
}

void RequireCapacities(const std::vector<int32_t>& capacity, size_t num_cells) {
  ENFILADE_CHECK(capacity.size() == num_cells);
  ENFILADE_CHECK(std::all_of(capacity.begin(), capacity.end(), [](int32_t value) {
    return value >= 0 && value <= kMaxGridCapacity;
  }));
}

void RequireValid(const GridCutProblem& problem) {
  ENFILADE_CHECK(problem.rows >= 0 && problem.cols >= 0 && problem.layers >= 0);
  // Cells and the frame round them are numbered in 32 bits.
  constexpr int64_t kMaxCells = std::numeric_limits<int32_t>::max();
  const int64_t num_framed_in_layer = (int64_t{problem.rows} + 2) * (int64_t{problem.cols} + 2);
  ENFILADE_CHECK(num_framed_in_layer <= kMaxCells);
  ENFILADE_CHECK(problem.layers == 1 ||
                 int64_t{problem.layers} + 2 <= kMaxCells / num_framed_in_layer);
  const size_t num_cells = problem.Index(0, 0, problem.layers);
  RequireCapacities(problem.source_capacity, num_cells);
  RequireCapacities(problem.sink_capacity, num_cells);
  RequireCapacities(problem.east_capacity, num_cells);
  RequireCapacities(problem.north_capacity, num_cells);
  RequireCapacities(problem.up_capacity, problem.layers == 1 ? 0 : num_cells);
}

}  // namespace

GridCutReport FindGridCut(const GridCutProblem& problem) {
  RequireValid(problem);
  return problem.layers == 1 ? FindCutIn<4>(problem) : FindCutIn<6>(problem);
}

int64_t CostOfCut(const GridCutProblem& problem, const std::vector<uint8_t>& is_source) {
  ENFILADE_CHECK(is_source.size() == problem.Index(0, 0, problem.layers));
  int64_t cost = 0;
  const auto pay = [&](size_t a, size_t b, int32_t capacity) {
    if ((is_source[a] != 0) != (is_source[b] != 0)) cost += capacity;
  };
  for (int layer = 0; layer < problem.layers; ++layer) {
    for (int row = 0; row < problem.rows; ++row) {
      for (int col = 0; col < problem.cols; ++col) {
        const size_t i = problem.Index(row, col, layer);
        cost += is_source[i] != 0 ? problem.sink_capacity[i] : problem.source_capacity[i];
        if (col + 1 < problem.cols) pay(i, i + 1, problem.east_capacity[i]);
        if (row + 1 < problem.rows)
          pay(i, problem.Index(row + 1, col, layer), problem.north_capacity[i]);
        if (layer + 1 < problem.layers)
          pay(i, problem.Index(row, col, layer + 1), problem.up_capacity[i]);
      }
    }
  }
  return cost;
}

}  // namespace enfilade
