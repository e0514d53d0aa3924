// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/ring_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

#include "enfilade/geometry/cross.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kLeastPart_m = 0.05;     // of a wall that stays, unless it is shorter
constexpr double kMinMeetingSine = 0.15;  // lines at smaller angles meet nowhere sure
constexpr double kTouching_m = 1e-4;
constexpr double kSlack = 1e-9;
constexpr size_t kLeastWalls = 3;

struct RingWall {
  Vector2d start, along;
  double length = 0;
  [[nodiscard]] double LeastPart() const {
    return std::min(kLeastPart_m, length) * (1 - kSlack) - kSlack;
  }
};

struct Corner {
  size_t from = 0, to = 0;        // places of walls in the ring, counted from the cut
  double leaves = 0, enters = 0;  // along the walls `from` and `to`, from their starts
  Vector2d at;
  double price = 0;
};

struct Cycle {
  double cost = std::numeric_limits<double>::infinity();
  std::vector<size_t> corners;
};

bool Touch(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const bool is_crossing = (Cross(b - a, c - a) > 0) != (Cross(b - a, d - a) > 0) &&
                           (Cross(d - c, a - c) > 0) != (Cross(d - c, b - c) > 0);
  return is_crossing || DistanceToSegment(a, c, d) < kTouching_m ||
         DistanceToSegment(b, c, d) < kTouching_m || DistanceToSegment(c, a, b) < kTouching_m ||
         DistanceToSegment(d, a, b) < kTouching_m;
}

class CurveSearch {
 public:
  CurveSearch(const Ring2& ring, const CornerPrice& price) : ring_(ring) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const Vector2d edge = ring[(i + 1) % ring.size()] - ring[i];
      walls_.push_back({ring[i], edge.normalized(), edge.norm()});
    }
    for (size_t from = 0; from < n(); ++from) {
      for (size_t step = 1; step <= std::min(n() - 1, kMaxLeftOut + 1); ++step)
        AddCorner(from, (from + step) % n(), step, price);
    }
    Cut();
    leaving_.resize(n());
    for (size_t c = 0; c < corners_.size(); ++c) leaving_[corners_[c].from].push_back(c);
  }

  std::vector<SimplerRing> Run() const {
    std::vector<SimplerRing> rings;
    double limit = std::numeric_limits<double>::infinity();
    std::vector<Cycle> best = Solve(n() - 1, {}, limit);
    for (size_t k = kLeastWalls; k < n(); ++k) {
      const Cycle cycle = Untangle(k, std::move(best[k]), limit);
      if (cycle.corners.empty()) continue;
      limit = cycle.cost;
      rings.push_back(RingOf(cycle));
    }
    SimplerRing whole{0, ring_, {}};
    for (size_t i = 0; i < n(); ++i) whole.wall_idx.push_back(i);
    rings.push_back(std::move(whole));
    return rings;
  }

 private:
  [[nodiscard]] size_t n() const { return walls_.size(); }

  void AddCorner(size_t from, size_t to, size_t step, const CornerPrice& price) {
    const RingWall &in = walls_[from], &out = walls_[to];
    if (step == 1) {
      corners_.push_back({from, to, in.length, 0, out.start, 0});
      return;
    }
    const double sine = Cross(in.along, out.along);
    if (std::abs(sine) < kMinMeetingSine) return;
    const Vector2d between = out.start - in.start;
    const double leaves = Cross(between, out.along) / sine;
    const double enters = Cross(between, in.along) / sine;
    if (leaves < in.LeastPart() || out.length - enters < out.LeastPart()) return;
    RingCorner corner{from, to, in.start + leaves * in.along, {}};
    // Against the ring's direction, from the start of `to` back to the end of `from`, over `at`.
    for (size_t k = 0; k < step; ++k) corner.change.push_back(ring_[(to + n() - k) % n()]);
    corner.change.push_back(corner.at);
    if (const std::optional<double> value = price(corner))
      corners_.push_back({from, to, leaves, enters, corner.at, *value});
  }

  /// Counts walls from where the fewest corners reach across.
  void Cut() {
    std::vector<size_t> num_across(n(), 0);
    for (const Corner& corner : corners_) {
      for (size_t i = corner.from; i != corner.to;) num_across[i = (i + 1) % n()] += 1;
    }
    cut_ = static_cast<size_t>(std::min_element(num_across.begin(), num_across.end()) -
                               num_across.begin());
    for (Corner& corner : corners_) {
      corner.from = (corner.from + n() - cut_) % n();
      corner.to = (corner.to + n() - cut_) % n();
    }
  }

  [[nodiscard]] const RingWall& WallAt(size_t place) const { return walls_[(place + cut_) % n()]; }

  /// Whether enough of the wall between two corners stays.
  [[nodiscard]] bool Fits(const Corner& first, const Corner& second) const {
    const RingWall& wall = WallAt(first.to);
    return std::min(second.leaves, wall.length) - std::max(first.enters, 0.0) >= wall.LeastPart();
  }

  /// By number of walls, up to `most`, the cheapest cycle of corners that fit; those that cost
  /// `limit` or more may be missing.
  [[nodiscard]] std::vector<Cycle> Solve(size_t most, const std::vector<size_t>& forbidden,
                                         double limit) const {
    std::vector<Cycle> best(most + 1);
    std::vector<char> is_forbidden(corners_.size(), 0);
    for (const size_t c : forbidden) is_forbidden[c] = 1;
    for (size_t last = 0; last < corners_.size(); ++last) {
      if (corners_[last].to < corners_[last].from && is_forbidden[last] == 0)
        CloseWith(last, is_forbidden, limit, best);
    }
    return best;
  }

  /// All cycles that pass the cut with the corner `last`.
  void CloseWith(size_t last, const std::vector<char>& is_forbidden, double limit,
                 std::vector<Cycle>& best) const {
    const size_t begin = corners_[last].to, end = corners_[last].from, most = best.size() - 1;
    constexpr size_t kNone = std::numeric_limits<size_t>::max();
    struct State {
      double cost = std::numeric_limits<double>::infinity();
      size_t before = kNone;  // the corner before
    };
    // states[c · (most + 1) + k]: `last` and k corners more, the k-th of them c.
    std::vector<State> states(corners_.size() * (most + 1));
    const auto at = [&](size_t c, size_t k) -> State& { return states[c * (most + 1) + k]; };
    const auto is_open = [&](size_t c) {
      return is_forbidden[c] == 0 && corners_[c].to > corners_[c].from && corners_[c].to <= end;
    };
    for (const size_t c : leaving_[begin]) {
      if (is_open(c) && most > 0 && Fits(corners_[last], corners_[c]))
        at(c, 1) = {corners_[last].price + corners_[c].price, last};
    }
    std::vector<size_t> order;  // a corner leads on to walls behind it only
    for (size_t place = begin; place < end; ++place) {
      for (const size_t c : leaving_[place]) {
        if (is_open(c)) order.push_back(c);
      }
    }
    for (const size_t c : order) {
      const Corner& corner = corners_[c];
      if (corner.to == end) {
        if (!Fits(corner, corners_[last])) continue;
        for (size_t k = 1; k < most; ++k) {
          const double cost = at(c, k).cost;
          if (k + 1 < kLeastWalls || cost >= best[k + 1].cost) continue;
          best[k + 1] = {cost, {last}};
          for (size_t i = c, m = k; i != last; i = at(i, m--).before)
            best[k + 1].corners.push_back(i);
          std::reverse(best[k + 1].corners.begin(), best[k + 1].corners.end());
        }
        continue;
      }
      for (const size_t next : leaving_[corner.to]) {
        if (!is_open(next) || !Fits(corner, corners_[next])) continue;
        for (size_t k = 1; k < most; ++k) {
          const double cost = at(c, k).cost + corners_[next].price;
          if (cost < limit && cost < at(next, k + 1).cost) at(next, k + 1) = {cost, c};
        }
      }
    }
  }

  /// Corners that no simple ring of the right orientation has all of: those at the ends of two
  /// walls that touch or cross; none where the cycle is such a ring.
  [[nodiscard]] std::vector<size_t> FindConflict(const Cycle& cycle) const {
    const std::vector<size_t>& ids = cycle.corners;
    const size_t k = ids.size();
    const auto vertex = [&](size_t i) -> const Vector2d& { return corners_[ids[i % k]].at; };
    for (size_t i = 0; i < k; ++i) {
      for (size_t j = i + 2; j < k; ++j) {
        if ((j + 1) % k == i || !Touch(vertex(i), vertex(i + 1), vertex(j), vertex(j + 1)))
          continue;
        return {ids[i], ids[i + 1], ids[j], ids[(j + 1) % k]};
      }
    }
    const bool is_turned = (SignedArea(RingOf(cycle).ring) < 0) != (SignedArea(ring_) < 0);
    return is_turned ? ids : std::vector<size_t>{};
  }

  /// The cheapest simple cycle of k corners, if it costs less than `limit`; `cycle` is the cheapest
  /// of all.
  [[nodiscard]] Cycle Untangle(size_t k, Cycle cycle, double limit) const {
    struct Node {
      Cycle cycle;
      std::vector<size_t> forbidden;
      int number = 0;
      bool operator>(const Node& other) const {
        return std::tie(cycle.cost, number) > std::tie(other.cycle.cost, other.number);
      }
    };
    std::priority_queue<Node, std::vector<Node>, std::greater<>> open;
    if (cycle.cost < limit) open.push({std::move(cycle), {}, 0});
    for (int num_solves = 0; !open.empty() && num_solves < kMaxBranches;) {
      const Node node = open.top();
      open.pop();
      const std::vector<size_t> conflict = FindConflict(node.cycle);
      if (conflict.empty()) return node.cycle;
      for (const size_t corner : conflict) {
        std::vector<size_t> forbidden = node.forbidden;
        forbidden.push_back(corner);
        Cycle other = std::move(Solve(k, forbidden, limit)[k]);
        ++num_solves;
        if (other.cost < limit) open.push({std::move(other), std::move(forbidden), num_solves});
      }
    }
    return {};
  }

  [[nodiscard]] SimplerRing RingOf(const Cycle& cycle) const {
    SimplerRing result{cycle.cost, {}, {}};
    for (const size_t c : cycle.corners) {
      result.ring.push_back(corners_[c].at);
      result.wall_idx.push_back((corners_[c].to + cut_) % n());
    }
    return result;
  }

  const Ring2& ring_;
  std::vector<RingWall> walls_;
  std::vector<Corner> corners_;
  std::vector<std::vector<size_t>> leaving_;  // by wall
  size_t cut_ = 0;
};

}  // namespace

std::vector<SimplerRing> FindSimplerRings(const Ring2& ring, const CornerPrice& price) {
  return CurveSearch(ring, price).Run();
}

}  // namespace enfilade
