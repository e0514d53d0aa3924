// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/optim/grid_cut.h"

#include <algorithm>
#include <array>
#include <limits>

#include "enfilade/base/check.h"

namespace enfilade {
namespace {

enum class Tree : uint8_t { kNone, kSource, kSink };

// Directions are 0 … 3: +col, +row, −col, −row; the opposite of d is d ^ 2. A cell's parent is one
// of them or:
constexpr uint8_t kTerminal = 4;  // the cell hangs on source or sink itself
constexpr uint8_t kOrphan = 5;    // it was cut off and waits for a new parent
constexpr uint8_t kNoParent = 6;  // it is in no tree

constexpr int32_t kNotQueued = -1;
constexpr int32_t kNoWay = std::numeric_limits<int32_t>::max();

struct Cell {
  std::array<int32_t, 4> residual{};  // what may still flow to the neighbour in each direction
  int32_t excess = 0;                 // residual from the source, or minus that to the sink
  int32_t distance = 0;               // to the terminal along the tree, as known at `time`
  int32_t time = 0;
  int32_t next_active = kNotQueued;
  Tree tree = Tree::kNone;
  uint8_t parent = kNoParent;
};

// Two trees of cells, one of what the source reaches through edges with residual capacity, one of
// what reaches the sink. They grow from their active cells until they meet; flow along the path
// through both saturates edges; what hung on these looks for new parents. No path is left when no
// cell is active.
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
    for (int32_t cell = FirstActive(); cell >= 0; cell = FirstActive()) {
      const Contact contact = Grow(cell);
      if (contact.source_cell < 0) {
        PopActive();
        continue;
      }
      ++time_;
      Augment(contact);
      for (size_t i = 0; i < orphans_.size(); ++i) Adopt(orphans_[i]);
      orphans_.clear();
    }
  }

  [[nodiscard]] GridCutReport TakeReport() {
    // What the source still reaches is the smallest source side.
    report_.is_source.resize(static_cast<size_t>(rows_) * static_cast<size_t>(cols_));
    size_t i = 0;
    for (int row = 0; row < rows_; ++row) {
      for (int col = 0; col < cols_; ++col)
        report_.is_source[i++] = At(IndexOf(row, col)).tree == Tree::kSource;
    }
    return std::move(report_);
  }

 private:
  // Where the trees touch: the way leads from a cell of the source's tree to one of the sink's.
  struct Contact {
    int32_t source_cell = -1;
    int direction = 0;
  };

  // A frame of cells without capacities lies round the grid, so that no step needs a check.
  [[nodiscard]] int32_t IndexOf(int row, int col) const {
    return (row + 1) * (cols_ + 2) + col + 1;
  }
  [[nodiscard]] Cell& At(int32_t cell) { return cells_[static_cast<size_t>(cell)]; }
  [[nodiscard]] int32_t Neighbor(int32_t cell, int direction) const {
    return cell + step_[static_cast<size_t>(direction)];
  }
  // Room for flow from `from` to its neighbour.
  [[nodiscard]] int32_t& Residual(int32_t from, int direction) {
    return At(from).residual[static_cast<size_t>(direction)];
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
    root.distance = 1;
    Activate(cell);
  }

  // The queue of active cells: the last one points to itself.
  void Activate(int32_t cell) {
    if (At(cell).next_active != kNotQueued) return;
    At(cell).next_active = cell;
    if (first_active_ < 0) {
      first_active_ = cell;
    } else {
      At(last_active_).next_active = cell;
    }
    last_active_ = cell;
  }

  void PopActive() {
    const int32_t cell = first_active_;
    first_active_ = At(cell).next_active == cell ? -1 : At(cell).next_active;
    At(cell).next_active = kNotQueued;
  }

  // Cells that fell out of their tree while they waited are passed over.
  [[nodiscard]] int32_t FirstActive() {
    while (first_active_ >= 0 && At(first_active_).tree == Tree::kNone) PopActive();
    return first_active_;
  }

  // Takes in the free neighbours of a cell, or finds the other tree beside it.
  Contact Grow(int32_t cell) {
    const Tree tree = At(cell).tree;
    for (int d = 0; d < 4; ++d) {
      if (RoomToChild(tree, cell, d) <= 0) continue;
      const int32_t next = Neighbor(cell, d);
      Cell& neighbor = At(next);
      if (neighbor.tree == Tree::kNone) {
        neighbor.tree = tree;
        HangOn(next, d ^ 2);
        Activate(next);
      } else if (neighbor.tree != tree) {
        return tree == Tree::kSource ? Contact{cell, d} : Contact{next, d ^ 2};
      } else if (neighbor.time <= At(cell).time && neighbor.distance > At(cell).distance) {
        HangOn(next, d ^ 2);
      }
    }
    return {};
  }

  void HangOn(int32_t cell, int direction) {
    const Cell& parent = At(Neighbor(cell, direction));
    At(cell).parent = static_cast<uint8_t>(direction);
    At(cell).time = parent.time;
    At(cell).distance = parent.distance + 1;
  }

  void Augment(const Contact& contact) {
    const int32_t source_cell = contact.source_cell,
                  sink_cell = Neighbor(source_cell, contact.direction);
    const int32_t flow = std::min(
        {Residual(source_cell, contact.direction), RoomToRoot(source_cell), RoomToRoot(sink_cell)});
    Residual(source_cell, contact.direction) -= flow;
    Residual(sink_cell, contact.direction ^ 2) += flow;
    PushToRoot(source_cell, flow);
    PushToRoot(sink_cell, flow);
    report_.cost += flow;
    ++report_.num_augmentations;
  }

  // The least residual between a cell and its terminal.
  [[nodiscard]] int32_t RoomToRoot(int32_t cell) {
    const Tree tree = At(cell).tree;
    int32_t room = kNoWay;
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

  // Finds the neighbour in the same tree that is nearest to the terminal as new parent; where there
  // is none, the cell leaves the tree and its children become orphans.
  void Adopt(int32_t cell) {
    const Tree tree = At(cell).tree;
    int best = -1;
    int32_t best_distance = kNoWay;
    for (int d = 0; d < 4; ++d) {
      const int32_t next = Neighbor(cell, d);
      if (At(next).tree != tree || RoomToChild(tree, next, d ^ 2) <= 0) continue;
      const int32_t distance = MeasureDistance(next);
      if (distance >= best_distance) continue;
      best = d;
      best_distance = distance;
    }
    if (best >= 0) {
      HangOn(cell, best);
      return;
    }
    for (int d = 0; d < 4; ++d) {
      const int32_t next = Neighbor(cell, d);
      if (At(next).tree != tree) continue;
      if (RoomToChild(tree, next, d ^ 2) > 0) Activate(next);
      if (At(next).parent == (d ^ 2)) Orphan(next);
    }
    At(cell).tree = Tree::kNone;
    At(cell).parent = kNoParent;
  }

  // Distance of a cell to its terminal, kNoWay when it hangs on an orphan. What is found on the way
  // is noted, so that no way is walked twice between two augmentations.
  [[nodiscard]] int32_t MeasureDistance(int32_t cell) {
    int32_t distance = 0, top = cell;
    while (true) {
      Cell& upper = At(top);
      if (upper.time == time_) {
        distance += upper.distance;
        break;
      }
      ++distance;
      if (upper.parent == kTerminal) {
        upper.time = time_;
        upper.distance = 1;
        break;
      }
      if (upper.parent == kOrphan) return kNoWay;
      top = Neighbor(top, upper.parent);
    }
    const int32_t result = distance;
    for (; At(cell).time != time_; cell = Neighbor(cell, At(cell).parent)) {
      At(cell).time = time_;
      At(cell).distance = distance--;
    }
    return result;
  }

  const int rows_, cols_;
  const std::array<int32_t, 4> step_;
  std::vector<Cell> cells_;
  std::vector<int32_t> orphans_;
  int32_t first_active_ = -1, last_active_ = -1;
  int32_t time_ = 0;
  GridCutReport report_;
};

void RequireValid(const GridCutProblem& problem) {
  ENFILADE_CHECK(problem.rows >= 0 && problem.cols >= 0);
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
