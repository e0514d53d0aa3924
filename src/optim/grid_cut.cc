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

// Directions are 0 … 3: +col, +row, −col, −row; the opposite of d is d ^ 2. A cell's parent is one
// of them or:
constexpr uint8_t kTerminal = 4;  // the cell hangs on source or sink itself
constexpr uint8_t kOrphan = 5;    // it was cut off and waits for a new parent

struct Cell {
  std::array<int32_t, 4> residual{};  // what may still flow to the neighbour in each direction
  int32_t excess = 0;                 // residual from the source, or minus that to the sink
  int32_t level = 0;                  // steps to the terminal along the tree
  Tree tree = Tree::kNone;
  uint8_t parent = kOrphan;
};

// Two trees of cells, one of what the source reaches through edges with residual capacity, one of
// what reaches the sink. Both are breadth-first: no residual edge leads over more than one level
// upwards, and all cells below the last level have taken in their neighbours. They grow level by
// level in turn. Where they touch, flow along the path through both saturates edges; what hung on
// these looks for new parents at the lowest level there is. A tree without a last level has grown
// to its end, and no path is left.
class TwoTrees {
 public:
  explicit TwoTrees(const GridCutProblem& problem)
      : rows_(problem.rows),
        cols_(problem.cols),
        step_{1, problem.cols + 2, -1, -(problem.cols + 2)},
        cells_(static_cast<size_t>(problem.rows + 2) * static_cast<size_t>(problem.cols + 2)) {
    for (int row = 0; row < rows_; ++row) {
      for (int col = 0; col < cols_; ++col) SetCapacities(problem, row, col);
    }
    for (int row = 0; row < rows_; ++row) {
      for (int col = 0; col < cols_; ++col) Root(IndexOf(row, col));
    }
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
    report_.is_source.reserve(static_cast<size_t>(rows_) * static_cast<size_t>(cols_));
    for (int row = 0; row < rows_; ++row) {
      for (int col = 0; col < cols_; ++col)
        report_.is_source.push_back(At(IndexOf(row, col)).tree == Tree::kSource);
    }
    return std::move(report_);
  }

 private:
  // The last level of a tree, whose cells have not taken in their neighbours. Lists may hold cells
  // that are no longer there.
  struct Front {
    int32_t level = 1;
    int32_t highest = 1;  // that a cell may have: one more while the tree grows
    std::vector<int32_t> cells;
    std::vector<int32_t> next;  // those of level + 1
  };

  // A frame of cells without capacities lies round the grid, so that no step needs a check.
  [[nodiscard]] int32_t IndexOf(int row, int col) const {
    return (row + 1) * (cols_ + 2) + col + 1;
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
                                 : Residual(Neighbor(cell, direction), direction ^ 2);
  }

  void SetCapacities(const GridCutProblem& problem, int row, int col) {
    const size_t i = problem.Index(row, col);
    const int32_t cell = IndexOf(row, col);
    At(cell).excess = problem.source_capacity[i] - problem.sink_capacity[i];
    report_.cost += std::min(problem.source_capacity[i], problem.sink_capacity[i]);
    if (col + 1 < cols_) {
      Residual(cell, 0) = Residual(Neighbor(cell, 0), 2) = problem.east_capacity[i];
    }
    if (row + 1 < rows_) {
      Residual(cell, 1) = Residual(Neighbor(cell, 1), 3) = problem.north_capacity[i];
    }
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
    for (int d = 0; d < 4;) {
      if (At(cell).tree != tree || At(cell).level != level) return;
      const int32_t next = Neighbor(cell, d);
      if (RoomToChild(tree, cell, d) <= 0 || At(next).tree == tree) {
        ++d;
      } else if (At(next).tree == Tree::kNone) {
        HangOn(next, d ^ 2, tree);
        ++d;
      } else if (tree == Tree::kSource) {
        Augment(cell, d);
      } else {
        Augment(next, d ^ 2);
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
    Residual(next, direction ^ 2) += flow;
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
      room = std::min(room, RoomToChild(tree, Neighbor(cell, to_parent), to_parent ^ 2));
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
      int32_t& downwards = Residual(parent, to_parent ^ 2);
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
    for (int d = 0; d < 4; ++d) {
      const int32_t next = Neighbor(cell, d);
      if (At(next).tree != tree || At(next).level >= level) continue;
      if (RoomToChild(tree, next, d ^ 2) <= 0) continue;
      level = At(next).level;
      parent = d;
      if (level + 1 == old_level) break;
    }
    if (parent < 0 || level + 1 != old_level) {
      for (int d = 0; d < 4; ++d) {
        const int32_t next = Neighbor(cell, d);
        if (At(next).tree == tree && At(next).parent == (d ^ 2)) Orphan(next);
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
      for (int d = 0; d < 4; ++d) {
        Cell& next = At(Neighbor(cell, d));
        if (Residual(cell, d) <= 0 || next.tree == Tree::kSource) continue;
        next.tree = Tree::kSource;
        reached.push_back(Neighbor(cell, d));
      }
    }
  }

  const int rows_, cols_;
  const std::array<int32_t, 4> step_;
  std::vector<Cell> cells_;
  std::vector<int32_t> orphans_;
  std::array<Front, 2> front_;
  GridCutReport report_;
};

void RequireValid(const GridCutProblem& problem) {
  ENFILADE_CHECK(problem.rows >= 0 && problem.cols >= 0);
  // Cells and the frame round them are numbered in 32 bits.
  ENFILADE_CHECK((int64_t{problem.rows} + 2) * (int64_t{problem.cols} + 2) <=
                 std::numeric_limits<int32_t>::max());
  const size_t num_cells = problem.Index(problem.rows, 0);
  for (const std::vector<int32_t>* capacity : {&problem.source_capacity, &problem.sink_capacity,
                                               &problem.east_capacity, &problem.north_capacity}) {
    ENFILADE_CHECK(capacity->size() == num_cells);
    ENFILADE_CHECK(std::all_of(capacity->begin(), capacity->end(), [](int32_t value) {
      return value >= 0 && value <= kMaxGridCapacity;
    }));
  }
}

}  // namespace

GridCutReport FindGridCut(const GridCutProblem& problem) {
  RequireValid(problem);
  TwoTrees trees(problem);
  trees.Saturate();
  return trees.TakeReport();
}

int64_t CostOfCut(const GridCutProblem& problem, const std::vector<uint8_t>& is_source) {
  ENFILADE_CHECK(is_source.size() == problem.Index(problem.rows, 0));
  int64_t cost = 0;
  for (int row = 0; row < problem.rows; ++row) {
    for (int col = 0; col < problem.cols; ++col) {
      const size_t i = problem.Index(row, col);
      cost += is_source[i] != 0 ? problem.sink_capacity[i] : problem.source_capacity[i];
      if (col + 1 < problem.cols && (is_source[i] != 0) != (is_source[i + 1] != 0))
        cost += problem.east_capacity[i];
      const size_t above = problem.Index(row + 1, col);
      if (row + 1 < problem.rows && (is_source[i] != 0) != (is_source[above] != 0))
        cost += problem.north_capacity[i];
    }
  }
  return cost;
}

}  // namespace enfilade
