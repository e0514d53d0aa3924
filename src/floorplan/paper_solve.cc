// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/paper_solve.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "enfilade/floorplan/cells.h"
#include "enfilade/optim/turn_loops.h"
#include "src/floorplan/grid_steps.h"
#include "src/floorplan/paper_anchors.h"
#include "src/floorplan/paper_contour.h"
#include "src/floorplan/paper_core.h"
#include "src/floorplan/paper_tangle.h"
#include "src/floorplan/paper_walls.h"
#include "src/floorplan/rooms.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr int kMaxHiddenRounds = 4;
constexpr int kMaxUntanglings = 8;
constexpr int kUntanglingSolves = 4;
constexpr double kLegMargin_m = 1;
constexpr int kCornersBeyondFirst = 8;  // without anchors: more than the evidence supports

/// The best ring for one number of corners.
struct TurnPlan {
  int64_t cost = 0;
  std::vector<GridVertex> ring;
};
using TurnPlans = std::map<int, TurnPlan>;  // by number of corners

/// From the easternmost core cell, the lowest of them, to the first crossing of the ring.
std::array<Vector2d, 2> CutLine(const GridFrame& frame, const ImageU8& core,
                                const std::vector<GridVertex>& ring) {
  GridVertex start{0, -1};
  for (int row = 0; row < frame.rows; ++row) {
    for (int col = start.col + 1; col < frame.cols; ++col) {
      if (core(row, col) != 0) start = {row, col};
    }
  }
  int end_col = frame.cols;
  for (size_t i = 0; i < ring.size(); ++i) {
    const GridVertex &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const auto [low, high] = std::minmax(a.row, b.row);
    if (a.col == b.col && a.col > start.col && low <= start.row && start.row < high)
      end_col = std::min(end_col, a.col);
  }
  const Vector2d from = frame.Center(start.row, start.col);
  return {from, {frame.origin.x() + end_col * frame.cell_m, from.y()}};
}

class LoopSolver {
 public:
  LoopSolver(const PaperField& field, const std::vector<EvidenceCamera>& cameras,
             const ImageU8& foreign, double margin_m, const PaperOptions& options,
             RunContext& context, PaperOutline& outline)
      : field_(field),
        cameras_(cameras),
        foreign_(foreign),
        margin_m_(margin_m),
        options_(options),
        context_(context),
        outline_(outline) {}

  void Solve() {
    FindFirstPath();
    if (outline_.outcome != GridLoopOutcome::kFound) return;
    FindContour();
    std::vector<WallAnchor> anchors;
    if (options_.use_anchors) anchors = ChooseAnchors();
    SolveForAllVertices(std::move(anchors));
    FillOutline();
  }

 private:
  [[nodiscard]] GridLoopProblem Problem() const {
    return MakePaperProblem(field_, outline_.core, foreign_, margin_m_);
  }

  /// The cheapest loop round the core; again while free space lies wholly outside of it.
  void FindFirstPath() {
    for (int round = 0; round < kMaxHiddenRounds; ++round) {
      context_.CheckStop();
      GridLoopReport report = FindShortestLoop(Problem());
      outline_.num_settled += report.num_settled;
      if (report.outcome != GridLoopOutcome::kFound) {
        if (round == 0) outline_.outcome = report.outcome;
        return;
      }
      outline_.outcome = report.outcome;
      first_ = std::move(report.ring);
      first_cost_ = report.cost;
      inside_first_ = CellsInside(field_.frame.rows, field_.frame.cols, first_);
      const bool is_last = round + 1 == kMaxHiddenRounds;
      if (is_last || AddHiddenSpace(field_, inside_first_, foreign_, options_.hidden_space_m2,
                                    outline_.core) == 0) {
        return;
      }
    }
  }

  void FindContour() { contour_ = TraceContour(ClosedFreeSpace(field_, outline_.core, foreign_)); }

  std::vector<WallAnchor> ChooseAnchors() {
    const AnchorScene scene{field_, cameras_, outline_.core, inside_first_, foreign_, contour_};
    const std::vector<WallAnchor> found = FindAnchors(scene, options_);
    context_.CheckStop();
    std::vector<WallAnchor> anchors = ValidateAnchors(scene, found);
    outline_.loop.num_anchors_refused = static_cast<int>(found.size() - anchors.size());
    return anchors;
  }

  /// With all anchors, and for the numbers of corners that they do not allow with fewer and fewer
  /// of them: the weaker half goes each time.
  void SolveForAllVertices(std::vector<WallAnchor> anchors) {
    int max_vertices = options_.max_vertices;
    if (anchors.empty()) {
      max_vertices = std::min(max_vertices, static_cast<int>(first_.size()) + kCornersBeyondFirst);
    }
    TurnLoopReport report = SolveUntangled(max_vertices, anchors);
    for (;;) {
      TakePlans(std::move(report));
      if (!plans_.empty() && automatic_vertices_ == 0) ChooseAutomatic(anchors);
      if (!plans_.empty()) max_vertices = LargestMissing();
      if (anchors.empty() || max_vertices < 4) break;
      DropWeakerHalf(anchors);
      report = Solve(max_vertices, anchors);
    }
    if (plans_.empty()) {
      const int num_corners = static_cast<int>(first_.size());
      plans_[num_corners] = {first_cost_ - int64_t{num_corners} * field_.turn_cost, first_};
      ChooseAutomatic({});
    }
  }

  /// The largest even number below the automatic one for which there is no plan yet; 0 if none.
  [[nodiscard]] int LargestMissing() const {
    int number = automatic_vertices_ - 2;
    while (number >= 4 && plans_.contains(number)) number -= 2;
    return std::max(number, 0);
  }

  [[nodiscard]] TurnLoopReport Solve(int max_vertices, const std::vector<WallAnchor>& anchors) {
    context_.CheckStop();
    TurnLoopProblem problem;
    problem.grid = Problem();
    std::vector<int> guide_idx;
    problem.guide = MakeGuide(contour_, anchors, guide_idx);
    for (size_t i = 0; i < anchors.size(); ++i)
      problem.anchors.push_back({guide_idx[i], anchors[i].heading});
    // The loop must have room to go round the anchors, however far they lie from the core.
    const int leg_margin = static_cast<int>(std::lround(kLegMargin_m / field_.frame.cell_m));
    problem.grid.margin_cells = std::max(problem.grid.margin_cells, MarginOf(anchors) + leg_margin);
    problem.max_turns = max_vertices;
    problem.max_leg_turns = options_.max_leg_edges;
    problem.leg_margin_cells = leg_margin;
    if (anchors.empty()) problem.max_untangling_solves = kUntanglingSolves;
    TurnLoopReport report = FindLoopsByTurns(problem);
    outline_.num_settled += report.num_relaxed;
    return report;
  }

  /// How far the anchors reach beyond the bounding box of the core, in cells.
  [[nodiscard]] int MarginOf(const std::vector<WallAnchor>& anchors) const {
    const ImageU8& core = outline_.core;
    int low_row = core.rows(), low_col = core.cols(), high_row = 0, high_col = 0;
    for (int row = 0; row < core.rows(); ++row) {
      for (int col = 0; col < core.cols(); ++col) {
        if (core(row, col) == 0) continue;
        low_row = std::min(low_row, row);
        low_col = std::min(low_col, col);
        high_row = row + 1;
        high_col = std::max(high_col, col + 1);
      }
    }
    int margin = 0;
    for (const WallAnchor& anchor : anchors) {
      const auto [row, col] = anchor.vertex;
      margin = std::max({margin, low_row - row, row - high_row, low_col - col, col - high_col});
    }
    return margin;
  }

  /// Lets anchors go, one by one, that make the best loop cross itself or go round another core.
  [[nodiscard]] TurnLoopReport SolveUntangled(int max_vertices, std::vector<WallAnchor>& anchors) {
    TurnLoopReport report = Solve(max_vertices, anchors);
    for (int round = 0; round < kMaxUntanglings && !anchors.empty(); ++round) {
      if (report.loops.empty()) break;
      const TurnLoop& best = *std::min_element(
          report.loops.begin(), report.loops.end(),
          [&](const TurnLoop& a, const TurnLoop& b) { return Total(a) < Total(b); });
      if (best.is_simple) break;
      anchors.erase(anchors.begin() + static_cast<ptrdiff_t>(TangledAnchor(best.ring, anchors)));
      ++outline_.loop.num_anchors_refused;
      report = Solve(max_vertices, anchors);
    }
    return report;
  }

  [[nodiscard]] int64_t Total(const TurnLoop& loop) const {
    return loop.cost + int64_t{loop.num_turns} * field_.turn_cost;
  }

  void TakePlans(TurnLoopReport report) {
    for (TurnLoop& loop : report.loops) {
      if (loop.is_simple && !EnclosesForeign(loop.ring))
        plans_.try_emplace(loop.num_turns, TurnPlan{loop.cost, std::move(loop.ring)});
    }
  }

  /// A loop that goes all round another core's cells has none of them beside its steps.
  [[nodiscard]] bool EnclosesForeign(const std::vector<GridVertex>& ring) const {
    const ImageU8 inside = CellsInside(field_.frame.rows, field_.frame.cols, ring);
    for (size_t i = 0; i < inside.data().size(); ++i) {
      if (inside.data()[i] != 0 && foreign_.data()[i] != 0) return true;
    }
    return false;
  }

  static void DropWeakerHalf(std::vector<WallAnchor>& anchors) {
    std::vector<size_t> order(anchors.size());
    for (size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return anchors[a].points > anchors[b].points; });
    order.resize(anchors.size() / 2);
    std::sort(order.begin(), order.end());
    std::vector<WallAnchor> kept;
    for (const size_t i : order) kept.push_back(anchors[i]);
    anchors = std::move(kept);
  }

  /// The automatic number of corners is that of the least D_k + α k.
  void ChooseAutomatic(const std::vector<WallAnchor>& anchors) {
    const auto total = [&](const auto& plan) {
      return plan.second.cost + int64_t{plan.first} * field_.turn_cost;
    };
    automatic_vertices_ =
        std::min_element(plans_.begin(), plans_.end(), [&](const auto& a, const auto& b) {
          return total(a) < total(b);
        })->first;
    for (const WallAnchor& anchor : anchors) {
      const auto h = static_cast<size_t>(anchor.heading);
      outline_.loop.anchors.push_back(
          {field_.frame.origin +
               field_.frame.cell_m * Vector2d(anchor.vertex.col, anchor.vertex.row),
           Vector2d(kColStep[h], kRowStep[h]), anchor.points});
    }
  }

  void FillOutline() {
    const GridFrame& frame = field_.frame;
    for (const auto& [num_vertices, plan] : plans_) {
      if (num_vertices == automatic_vertices_) outline_.automatic_idx = outline_.curve.size();
      outline_.curve.push_back(
          MeasureOutline(field_, {RingInMetres(frame, plan.ring), {}}, field_.ToMetres(plan.cost)));
    }
    PaperLoop& loop = outline_.loop;
    loop.cut = CutLine(frame, outline_.core, first_);
    loop.contour = RingInMetres(frame, CornersOf(contour_));
    loop.first_path = RingInMetres(frame, first_);
    loop.first_cost_m = field_.ToMetres(first_cost_);
    loop.second_path = outline_.curve[outline_.automatic_idx].polygon.outer;
  }

  static std::vector<GridVertex> CornersOf(const std::vector<GridVertex>& contour) {
    std::vector<int> none;
    return MakeGuide(contour, {}, none);
  }

  const PaperField& field_;
  const std::vector<EvidenceCamera>& cameras_;
  const ImageU8& foreign_;
  double margin_m_;
  const PaperOptions& options_;
  RunContext& context_;
  PaperOutline& outline_;

  std::vector<GridVertex> first_;
  int64_t first_cost_ = 0;
  ImageU8 inside_first_;
  std::vector<GridVertex> contour_;
  TurnPlans plans_;
  int automatic_vertices_ = 0;  // 0: not chosen yet
};

}  // namespace

void PaperOptions::Visit(OptionVisitor& v) {
  v("alpha_m", alpha_m, "Cost of a corner, in metres of unseen wall.", {0.001, 10});
  v("wall_points_per_m", wall_points_per_m,
    "Wall points a metre of wall from which a cell's wall counts as seen.", {0.1, 1e6});
  v("hidden_space_m2", hidden_space_m2,
    "Free space outside the first path from which on it must be enclosed.", {0.01, 1000});
  v("use_anchors", use_anchors, "Solve a second time, with anchors on walls.");
  v("anchor_points_per_m", anchor_points_per_m, "As wall_points_per_m, for a wall with an anchor.",
    {0.1, 1e6});
  v("anchor_support_m", anchor_support_m, "Length of wall seen without a gap about an anchor.",
    {0.05, 5});
  v("anchor_spacing_m", anchor_spacing_m, "Least distance of anchors.", {0.05, 10});
  v("anchor_reach_m", anchor_reach_m, "Largest distance of an anchor from free space.", {0.05, 2});
  v("max_leg_edges", max_leg_edges, "Most edges between adjacent anchors.", {1, 32});
  v("max_vertices", max_vertices, "Most corners of an outline.", {4, 1000});
}

PaperOutline SolvePaperLoop(const PaperField& field, const std::vector<EvidenceCamera>& cameras,
                            const ImageU8& core, const ImageU8& foreign, double margin_m,
                            const PaperOptions& options, RunContext& context) {
  PaperOutline outline;
  outline.core = core;
  LoopSolver(field, cameras, foreign, margin_m, options, context, outline).Solve();
  return outline;
}

}  // namespace enfilade
