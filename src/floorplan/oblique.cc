// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/oblique.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "enfilade/geometry/angles.h"
#include "src/floorplan/edge_cost.h"
#include "src/floorplan/wall_band.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr int kCellsPerPoint = 2;
constexpr double kMaxWall_m = 15;
constexpr double kLengthPerStride_m = 0.75;  // of a wall for which every point is tried
constexpr double kMaxStep_m = 0.5;           // of the ring beside the wall
constexpr double kMinAngle_rad = DegToRad(4);
// Headings other than 45° must show that they are no error of the evidence, and no jog.
constexpr double kMinSideways_m = 0.2;
constexpr double kFlat_rad = DegToRad(20);
constexpr size_t kMinCornersIfFlat = 3;

// What an oblique wall must show: a straight face almost all along. At 45° wall profiles have
// planes of their own, so faces are sharp there; other headings come as many short steps.
constexpr double kMinSeenShare = 0.9;
constexpr double kMinSharpShare = 0.85;
constexpr double kMaxBend_m = 0.05;
constexpr double kBendPiece_m = 0.25;
constexpr int kMaxBendPieces = 6;
constexpr double kMinGain_m = 0.2;  // over the old ring, in metres of unseen wall without corners

constexpr int kMaxSideSteps = 2;  // that a wall may lie beside its points, in cells
constexpr double kRefineReach_m = 0.1;
constexpr double kMaxRefinedTurn_rad = DegToRad(6);
constexpr double kSnap_m = 0.04;  // ends move so far to 45°
constexpr double kMaxVertexShift_m = 0.5;
constexpr double kShortestEdge_m = 0.03;

struct RingPoint {
  Vector2d position;
  size_t edge = 0;  // that the point lies on, or that begins there
  bool is_corner = false;
};

struct Line {
  Vector2d a, b;

  [[nodiscard]] Vector2d Along() const { return b - a; }
  [[nodiscard]] Vector2d Direction() const { return Along().normalized(); }
  [[nodiscard]] Vector2d Middle() const { return 0.5 * (a + b); }
  [[nodiscard]] double Length() const { return Along().norm(); }
};

// A wall that may replace the ring between two of its points.
struct Chord {
  size_t from = 0, to = 0;
  double cost = 0;
  Line line;
};

// A straight piece of the new ring: an edge of the old one or a chord, `index` among them.
struct Piece {
  Line line;
  bool is_chord = false;
  size_t index = 0;
};

Vector2d LeftOf(const Vector2d& direction) { return {-direction.y(), direction.x()}; }

double HeadingOf(const Vector2d& v) { return std::atan2(v.y(), v.x()); }

double AngleToAxes(const Vector2d& v) { return std::abs(WrapQuarter(HeadingOf(v))); }

bool IsDiagonal(const Vector2d& along) {
  return 0.5 * along.norm() * std::sin(0.25 * kPi - AngleToAxes(along)) < kSnap_m;
}

// Turned to 45° where the ends move little.
Line SnappedToDiagonal(const Line& line) {
  if (!IsDiagonal(line.Along())) return line;
  const double off = WrapQuarter(HeadingOf(line.Along()) - 0.25 * kPi);
  const Vector2d half = Eigen::Rotation2Dd(-off) * (0.5 * line.Along());
  return {line.Middle() - half, line.Middle() + half};
}

// Turned and shifted to the evidence beside its two halves.
Line Refined(const LoopField& field, Line line) {
  for (int round = 0; round < 2; ++round) {
    const Vector2d left = LeftOf(line.Direction());
    const WallBand first = MeasureWallBand(field, line.a, line.Middle(), kRefineReach_m),
                   second = MeasureWallBand(field, line.Middle(), line.b, kRefineReach_m);
    if (!first.has_peak || !second.has_peak) break;
    const double mean_m = 0.5 * (first.offset_m + second.offset_m);
    const double turned_m = second.offset_m - first.offset_m;  // of the ends
    if (std::abs(turned_m) > 0.5 * line.Length() * std::tan(kMaxRefinedTurn_rad)) break;
    line = {line.a + (mean_m - turned_m) * left, line.b + (mean_m + turned_m) * left};
  }
  return SnappedToDiagonal(line);
}

// Whether a face is seen along the line, and each piece of it on the line.
bool IsStraightFace(const LoopField& field, const Line& line) {
  if (MeasureWallBand(field, line.a, line.b, kRefineReach_m).seen_share < kMinSeenShare)
    return false;
  const int count = std::clamp(static_cast<int>(line.Length() / kBendPiece_m), 1, kMaxBendPieces);
  for (int k = 0; k < count; ++k) {
    const Vector2d a = line.a + static_cast<double>(k) / count * line.Along(),
                   b = line.a + static_cast<double>(k + 1) / count * line.Along();
    const WallBand band = MeasureWallBand(field, a, b, 2 * kRefineReach_m);
    if (!band.has_peak || std::abs(band.offset_m) > kMaxBend_m) return false;
  }
  return true;
}

std::optional<Vector2d> MeetingPoint(const Line& p, const Line& q) {
  Eigen::Matrix2d directions;
  directions << p.Direction(), -q.Direction();
  if (std::abs(directions.determinant()) < std::sin(kMinAngle_rad)) return std::nullopt;
  return p.a + directions.inverse().row(0).dot(q.a - p.a) * p.Direction();
}

class RingRedrawer {
 public:
  RingRedrawer(const LoopField& field, const FloorplanOptions& options, const Ring2& ring)
      : field_(field), options_(options), ring_(ring), turn_cost_(field.turn_cost / kCostPerMetre) {
    PlacePoints();
    FindChords();
  }

  // The new ring, or none where the old one is cheapest.
  [[nodiscard]] std::optional<Ring2> Redraw() {
    while (!chords_.empty()) {
      // No chord of the first solution crosses its seam; the second seam is a vertex of it.
      std::vector<Chord> chosen = CheapestChords(MiddleOfLongestEdge(), false);
      if (chosen.empty()) break;
      chosen = CheapestChords(chosen.front().to, true);
      if (chosen.empty()) break;
      std::vector<Piece> pieces = PiecesOf(chosen);
      std::optional<size_t> misfit;
      std::optional<Ring2> ring = JoinPieces(pieces, misfit);
      if (!misfit) return ring ? WithoutNeedlessPieces(std::move(pieces), std::move(*ring)) : ring;
      DropLike(chosen[*misfit]);
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] const RingPoint& Point(size_t i) const { return points_[i % points_.size()]; }

  void PlacePoints() {
    const double spacing_m = kCellsPerPoint * field_.frame.cell_m;
    for (size_t e = 0; e < ring_.size(); ++e) {
      const Line edge = Edge(e);
      const int count = std::max(1, static_cast<int>(edge.Length() / spacing_m));
      for (int k = 0; k < count; ++k)
        points_.push_back({edge.a + k * spacing_m * edge.Direction(), e, k == 0});
    }
    cost_ = length_m_ = {0};
    for (size_t i = 0; i < 2 * points_.size(); ++i) {
      const Line step{Point(i).position, Point(i + 1).position};
      const double cost = i < points_.size() ? EdgeCost(field_, options_, step.a, step.b)
                                             : StepCost(i - points_.size());
      cost_.push_back(cost_.back() + cost);
      length_m_.push_back(length_m_.back() + step.Length());
    }
  }

  [[nodiscard]] Line Edge(size_t e) const { return {ring_[e], ring_[(e + 1) % ring_.size()]}; }
  [[nodiscard]] double StepCost(size_t i) const { return cost_[i + 1] - cost_[i]; }

  void FindChords() {
    for (size_t i = 0; i < points_.size(); ++i) {
      std::vector<Vector2d> corners;  // passed on the way
      for (size_t j = i + 1; j < i + points_.size(); ++j) {
        if (length_m_[j] - length_m_[i] > kMaxWall_m) break;
        if (j - 1 > i && Point(j - 1).is_corner) corners.push_back(Point(j - 1).position);
        if (!corners.empty()) ConsiderChord(i, j, corners);
      }
    }
  }

  void ConsiderChord(size_t i, size_t j, const std::vector<Vector2d>& corners) {
    const Line chord{Point(i).position, Point(j).position};
    // A long wall turns little between one point and the next.
    const auto stride =
        static_cast<size_t>(std::clamp(chord.Length() / kLengthPerStride_m, 1.0, 4.0));
    if ((i % stride != 0 && !Point(i).is_corner) || (j % stride != 0 && !Point(j).is_corner))
      return;
    if (!IsPlausible(chord.Along(), corners.size()) || TurnsBack(chord, corners)) return;
    const double old_cost = cost_[j] - cost_[i];
    const double saved_turns =
        static_cast<double>(corners.size()) + Point(i).is_corner + Point(j).is_corner - 2;
    const double max_cost =
        old_cost + std::min(-kMinGain_m, saved_turns * turn_cost_ - HeadingCost(chord.Along()));
    if (max_cost <= 0) return;
    const bool is_far = std::any_of(corners.begin(), corners.end(), [&](const Vector2d& corner) {
      return DistanceToSegment(corner, chord.a, chord.b) > kMaxStep_m;
    });
    if (is_far) return;
    const Line seen = BestSeenBeside(chord);
    const double seen_share = SeenShare(field_, seen.a, seen.b);
    if (seen_share < kMinSeenShare || (1 - seen_share) * chord.Length() >= max_cost) return;
    const Line wall = Refined(field_, seen);
    const double cost = EdgeCost(field_, options_, wall.a, wall.b);
    if (cost >= max_cost || !IsPlausible(wall.Along(), corners.size()) ||
        !IsStraightFace(field_, wall) ||
        (IsDiagonal(wall.Along()) && SeenShare(field_, wall.a, wall.b) < kMinSharpShare))
      return;
    chords_.push_back({i, j % points_.size(), cost + HeadingCost(wall.Along()), wall});
  }

  // A staircase never does: what turns back is the end of a wall that juts into the room.
  [[nodiscard]] static bool TurnsBack(const Line& chord, const std::vector<Vector2d>& corners) {
    const Vector2d along = chord.Direction();
    const Vector2d* before = &chord.a;
    for (const Vector2d& corner : corners) {
      if (along.dot(corner - *before) < 0) return true;
      before = &corner;
    }
    return along.dot(chord.b - *before) < 0;
  }

  // Whether a wall may run so instead of a stretch of the ring with that many corners.
  [[nodiscard]] bool IsPlausible(const Vector2d& along, size_t num_corners) const {
    if (along.norm() < options_.min_oblique_m) return false;
    if (IsDiagonal(along)) return true;
    const double angle = AngleToAxes(along);
    return angle >= kMinAngle_rad && along.cwiseAbs().minCoeff() >= kMinSideways_m &&
           (angle >= kFlat_rad || num_corners >= kMinCornersIfFlat);
  }

  [[nodiscard]] double HeadingCost(const Vector2d& along) const {
    return (IsDiagonal(along) ? 0.25 : 1.0) * options_.heading_cost_m;
  }

  [[nodiscard]] Line BestSeenBeside(const Line& chord) const {
    const Vector2d side = field_.frame.cell_m * LeftOf(chord.Direction());
    Line best = chord;
    double best_share = -1;
    for (int k = 0; k <= 2 * kMaxSideSteps; ++k) {
      const Vector2d shift = (k % 2 == 0 ? 0.5 * k : -0.5 * (k + 1)) * side;  // near ones first
      const double share = SeenShare(field_, chord.a + shift, chord.b + shift);
      if (share <= best_share + 1e-6) continue;
      best_share = share;
      best = {chord.a + shift, chord.b + shift};
    }
    return best;
  }

  [[nodiscard]] size_t MiddleOfLongestEdge() const {
    size_t longest = 0;
    for (size_t e = 1; e < ring_.size(); ++e) {
      if (Edge(e).Length() > Edge(longest).Length()) longest = e;
    }
    const auto distance = [&](const RingPoint& point) {
      return (point.position - Edge(longest).Middle()).norm();
    };
    const auto nearest = std::min_element(
        points_.begin(), points_.end(),
        [&](const RingPoint& p, const RingPoint& q) { return distance(p) < distance(q); });
    return static_cast<size_t>(nearest - points_.begin());
  }

  // The chords of the cheapest ring among those without a chord across the point `seam`, which is
  // a vertex of the ring if is_vertex. Dynamic programming over the points from there on.
  [[nodiscard]] std::vector<Chord> CheapestChords(size_t seam, bool is_vertex) const {
    enum Arrival { kAlongRing, kByChord };
    struct State {
      double cost = std::numeric_limits<double>::infinity();
      Arrival before = kAlongRing;
      const Chord* chord = nullptr;
    };
    const size_t n = points_.size();
    std::vector<std::vector<const Chord*>> chords_to(n + 1);
    const auto begin_of = [&](const Chord& chord) { return (chord.from + n - seam) % n; };
    for (const Chord& chord : chords_) {
      const size_t end = (chord.to + n - seam - 1) % n + 1;
      if (begin_of(chord) < end) chords_to[end].push_back(&chord);
    }
    std::vector<std::array<State, 2>> states(n + 1);
    states[0][is_vertex ? kByChord : kAlongRing].cost = 0;
    const auto offer = [](double cost, Arrival before, const Chord* chord, State& state) {
      if (cost < state.cost) state = {cost, before, chord};
    };
    for (size_t k = 1; k <= n; ++k) {
      const size_t last = (seam + k - 1) % n;
      const bool turns = points_[last].is_corner && (k > 1 || is_vertex);
      State& along_ring = states[k][kAlongRing];
      offer(states[k - 1][kAlongRing].cost + StepCost(last) + (turns ? turn_cost_ : 0), kAlongRing,
            nullptr, along_ring);
      offer(states[k - 1][kByChord].cost + StepCost(last) + turn_cost_, kByChord, nullptr,
            along_ring);
      for (const Chord* chord : chords_to[k]) {
        for (const Arrival before : {kAlongRing, kByChord}) {
          offer(states[begin_of(*chord)][before].cost + chord->cost + turn_cost_, before, chord,
                states[k][kByChord]);
        }
      }
    }
    const double last_turn = is_vertex ? 0 : turn_cost_;
    Arrival arrival =
        states[n][kByChord].cost + last_turn < states[n][kAlongRing].cost ? kByChord : kAlongRing;
    std::vector<Chord> chosen;
    for (size_t k = n; k > 0;) {
      const State& state = states[k][arrival];
      if (state.chord != nullptr) chosen.push_back(*state.chord);
      k = state.chord != nullptr ? begin_of(*state.chord) : k - 1;
      arrival = state.before;
    }
    std::reverse(chosen.begin(), chosen.end());
    return chosen;
  }

  // The chords, and the edges of the old ring between them.
  [[nodiscard]] std::vector<Piece> PiecesOf(const std::vector<Chord>& chosen) const {
    std::vector<Piece> pieces;
    for (size_t c = 0; c < chosen.size(); ++c) {
      pieces.push_back({chosen[c].line, true, c});
      const size_t next = chosen[(c + 1) % chosen.size()].from;
      for (size_t i = chosen[c].to; i % points_.size() != next; ++i) {
        const size_t edge = Point(i).edge;
        if (pieces.back().is_chord || pieces.back().index != edge)
          pieces.push_back({Edge(edge), false, edge});
      }
    }
    return pieces;
  }

  [[nodiscard]] bool IsOldCorner(const Piece& before, const Piece& after) const {
    return !before.is_chord && !after.is_chord && (before.index + 1) % ring_.size() == after.index;
  }

  // The ring of the pieces, each prolonged or cut to where it meets its neighbours; pieces that
  // nothing is left of are left out. A chord that meets its neighbour nowhere near is a misfit.
  [[nodiscard]] std::optional<Ring2> JoinPieces(std::vector<Piece>& pieces,
                                                std::optional<size_t>& misfit) const {
    while (pieces.size() >= 3) {
      const size_t n = pieces.size();
      Ring2 ring;  // ring[i]: where piece i begins
      for (size_t i = 0; i < n; ++i) {
        const Piece &before = pieces[(i + n - 1) % n], &after = pieces[i];
        if (IsOldCorner(before, after)) {
          ring.push_back(after.line.a);
          continue;
        }
        const std::optional<Vector2d> point = MeetingPoint(before.line, after.line);
        const auto is_near = [&](const Vector2d& end) {
          return (*point - end).norm() <= kMaxVertexShift_m;
        };
        if (!point || (!is_near(before.line.b) && !is_near(after.line.a))) {
          misfit = NearestChord(pieces, i);
          return std::nullopt;
        }
        ring.push_back(*point);
      }
      const std::optional<size_t> vanished = VanishedPiece(pieces, ring);
      if (!vanished) {
        if (IsSimple(ring) && SignedArea(ring) * SignedArea(ring_) > 0) return ring;
        misfit = NearestChord(pieces, 0);
        return std::nullopt;
      }
      pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(*vanished));
    }
    return std::nullopt;
  }

  // Steps of the old ring are left over beside chords that begin where they could first, and chords
  // beside better ones: what makes the ring cheaper by its absence goes.
  [[nodiscard]] Ring2 WithoutNeedlessPieces(std::vector<Piece> pieces, Ring2 ring) const {
    double cost = RingCost(pieces, ring);
    for (size_t i = 0; i < pieces.size();) {
      bool is_better = false;
      for (const size_t count : {1, 2}) {
        if (!IsShortBesideChord(pieces, ring, i, count)) continue;
        std::vector<Piece> fewer = pieces;
        std::rotate(fewer.begin(), fewer.begin() + static_cast<std::ptrdiff_t>(i), fewer.end());
        fewer.erase(fewer.begin(), fewer.begin() + static_cast<std::ptrdiff_t>(count));
        std::optional<size_t> misfit;
        std::optional<Ring2> fewer_ring = JoinPieces(fewer, misfit);
        if (!fewer_ring) continue;
        const double fewer_cost = RingCost(fewer, *fewer_ring);
        if (fewer_cost >= cost) continue;
        cost = fewer_cost;
        pieces = std::move(fewer);
        ring = std::move(*fewer_ring);
        is_better = true;
        break;
      }
      i = is_better ? 0 : i + 1;
    }
    return ring;
  }

  [[nodiscard]] double RingCost(const std::vector<Piece>& pieces, const Ring2& ring) const {
    double cost = static_cast<double>(ring.size()) * turn_cost_;
    for (size_t i = 0; i < ring.size(); ++i) {
      cost += EdgeCost(field_, options_, ring[i], ring[(i + 1) % ring.size()]);
      if (pieces[i].is_chord) cost += HeadingCost(pieces[i].line.Along());
    }
    return cost;
  }

  // Whether pieces i … i + count are short, and one on either side of them is a chord.
  [[nodiscard]] static bool IsShortBesideChord(const std::vector<Piece>& pieces, const Ring2& ring,
                                               size_t i, size_t count) {
    const size_t n = pieces.size();
    if (n < count + 3) return false;
    for (size_t k = i; k < i + count; ++k) {
      if ((ring[(k + 1) % n] - ring[k % n]).norm() > kMaxStep_m) return false;
    }
    return pieces[(i + n - 1) % n].is_chord || pieces[(i + count) % n].is_chord;
  }

  // Of the pieces that end at a chord, the one with the least of its length left if that is too
  // little.
  [[nodiscard]] std::optional<size_t> VanishedPiece(const std::vector<Piece>& pieces,
                                                    const Ring2& ring) const {
    const size_t n = pieces.size();
    std::optional<size_t> shortest;
    double shortest_m = kShortestEdge_m;
    for (size_t i = 0; i < n; ++i) {
      const bool is_untouched = IsOldCorner(pieces[(i + n - 1) % n], pieces[i]) &&
                                IsOldCorner(pieces[i], pieces[(i + 1) % n]);
      const double left_m = pieces[i].line.Direction().dot(ring[(i + 1) % n] - ring[i]);
      if (is_untouched || left_m >= shortest_m) continue;
      shortest_m = left_m;
      shortest = i;
    }
    return shortest;
  }

  // The chord at the beginning of piece i, or the next one.
  [[nodiscard]] static std::optional<size_t> NearestChord(const std::vector<Piece>& pieces,
                                                          size_t i) {
    for (size_t k = 0; k < pieces.size(); ++k) {
      const Piece& piece = pieces[(i + pieces.size() - 1 + k) % pieces.size()];
      if (piece.is_chord) return piece.index;
    }
    return std::nullopt;
  }

  void DropLike(const Chord& misfit) {
    constexpr size_t kAlike = 2;  // points
    const auto is_alike = [&](size_t i, size_t j) {
      const size_t n = points_.size(), apart = (i + n - j) % n;
      return std::min(apart, n - apart) <= kAlike;
    };
    std::erase_if(chords_, [&](const Chord& chord) {
      return is_alike(chord.from, misfit.from) && is_alike(chord.to, misfit.to);
    });
  }

  const LoopField& field_;
  const FloorplanOptions& options_;
  const Ring2& ring_;
  double turn_cost_ = 0;
  std::vector<RingPoint> points_;
  std::vector<double> cost_, length_m_;  // of the ring up to each point, for two laps
  std::vector<Chord> chords_;
};

bool HolesAreInside(const Polygon2& polygon) {
  return std::all_of(polygon.holes.begin(), polygon.holes.end(), [&](const Ring2& hole) {
    return std::all_of(hole.begin(), hole.end(),
                       [&](const Vector2d& p) { return Contains(polygon.outer, p); });
  });
}

void DrawObliqueWalls(const LoopField& field, const FloorplanOptions& options, Polygon2& polygon) {
  for (size_t r = 0; r <= polygon.holes.size(); ++r) {
    Polygon2 redrawn = polygon;
    Ring2& ring = r == 0 ? redrawn.outer : redrawn.holes[r - 1];
    if (ring.empty()) continue;
    std::optional<Ring2> new_ring = RingRedrawer(field, options, ring).Redraw();
    if (!new_ring) continue;
    ring = std::move(*new_ring);
    if (HolesAreInside(redrawn)) polygon = std::move(redrawn);
  }
}

}  // namespace

void DrawObliqueWalls(const LoopField& field, const FloorplanOptions& options, RunContext& context,
                      std::vector<Polygon2>& polygons) {
  if (options.min_oblique_m <= 0) return;
  ParallelFor(context, "oblique walls", static_cast<int64_t>(polygons.size()), [&](int64_t i) {
    DrawObliqueWalls(field, options, polygons[static_cast<size_t>(i)]);
  });
}

}  // namespace enfilade
