// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/paper_anchors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "enfilade/evidence/ray_traversal.h"
#include "enfilade/floorplan/cells.h"
#include "src/floorplan/grid_steps.h"
#include "src/floorplan/paper_legs.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kMinFreeShare = 0.8;   // of the line of sight
constexpr double kSightMargin_m = 0.1;  // before the wall, where its own evidence lies
constexpr double kBeside_m = 0.05;      // how far the first path may run behind its wall
constexpr int kAcross = 2;              // cells to either side of a wall's line

/// Evidence of walls along one axis, smoothed.
struct AlignedWall {
  ImageF points;   ///< mean over the window along the wall, Gaussian (σ one cell) across it
  ImageF support;  ///< metres of the window where something was seen
};

/// Sums over a window of `half` cells to both sides, along rows or along columns.
ImageF WindowSums(const ImageF& image, int half, bool along_cols) {
  ImageF sums(image.rows(), image.cols());
  const int lines = along_cols ? image.rows() : image.cols();
  const int length = along_cols ? image.cols() : image.rows();
  const auto at = [&](auto& picture, int line, int k) -> auto& {
    return along_cols ? picture(line, k) : picture(k, line);
  };
  for (int line = 0; line < lines; ++line) {
    double sum = 0;  // of whole numbers and halves: exact
    for (int k = 0; k < length + half; ++k) {
      if (k < length) sum += at(image, line, k);
      if (k - 2 * half - 1 >= 0) sum -= at(image, line, k - 2 * half - 1);
      if (k >= half) at(sums, line, k - half) = static_cast<float>(sum);
    }
  }
  return sums;
}

AlignedWall MakeAlignedWall(const PaperField& field, double window_m, bool is_horizontal) {
  const int rows = field.frame.rows, cols = field.frame.cols;
  const int half = std::max(1, static_cast<int>(std::lround(0.5 * window_m / field.frame.cell_m)));
  const ImageF along = WindowSums(field.wall, half, is_horizontal);
  ImageF is_seen(rows, cols);
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      for (int t = -1; t <= 1; ++t) {
        const int r = is_horizontal ? row + t : row, c = is_horizontal ? col : col + t;
        if (field.frame.IsInside(r, c) && field.IsSeen(r, c)) is_seen(row, col) = 1;
      }
    }
  }
  AlignedWall wall{ImageF(rows, cols), WindowSums(is_seen, half, is_horizontal)};
  for (float& cells : wall.support.data()) cells *= static_cast<float>(field.frame.cell_m);
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      float sum = 0;
      for (int t = -kAcross; t <= kAcross; ++t) {
        const int r = is_horizontal ? row + t : row, c = is_horizontal ? col : col + t;
        if (field.frame.IsInside(r, c))
          sum += std::exp(-0.5F * static_cast<float>(t * t)) * along(r, c);
      }
      wall.points(row, col) = sum / static_cast<float>(2 * half + 1);
    }
  }
  return wall;
}

struct Candidate {
  float points = 0;
  double support_m = 0;
  int row = 0, col = 0;
  bool is_horizontal = false;
  // The strongest first, then by place.
  [[nodiscard]] auto Key() const { return std::make_tuple(-points, row, col, is_horizontal); }
  friend bool operator<(const Candidate& a, const Candidate& b) { return a.Key() < b.Key(); }
};

/// Cells where the smoothed evidence is largest across the wall.
std::vector<Candidate> FindCandidates(const PaperField& field, const PaperOptions& options) {
  std::vector<Candidate> candidates;
  const AlignedWall horizontal = MakeAlignedWall(field, options.anchor_support_m, true);
  const AlignedWall vertical = MakeAlignedWall(field, options.anchor_support_m, false);
  const auto min_points =
      static_cast<float>(std::max(1.0, options.anchor_points_per_m * field.frame.cell_m));
  const auto min_support = static_cast<float>(options.anchor_support_m - 1e-6);
  for (int row = kAcross; row + kAcross < field.frame.rows; ++row) {
    for (int col = kAcross; col + kAcross < field.frame.cols; ++col) {
      for (const bool is_horizontal : {true, false}) {
        const AlignedWall& wall = is_horizontal ? horizontal : vertical;
        const AlignedWall& other = is_horizontal ? vertical : horizontal;
        const float points = wall.points(row, col);
        if (points < min_points || wall.support(row, col) < min_support) continue;
        if (points <= other.points(row, col)) continue;
        const int dr = is_horizontal ? 1 : 0, dc = 1 - dr;
        if (points < wall.points(row + dr, col + dc)) continue;
        if (points <= wall.points(row - dr, col - dc)) continue;
        candidates.push_back({points, wall.support(row, col), row, col, is_horizontal});
      }
    }
  }
  std::sort(candidates.begin(), candidates.end());
  return candidates;
}

/// For every vertex the places where the contour passes it, by the heading in which it leaves.
class ContourIndex {
 public:
  ContourIndex(const GridFrame& frame, const std::vector<GridVertex>& contour)
      : cols_(frame.cols + 1), first_(static_cast<size_t>((frame.rows + 1) * cols_), -1) {
    next_.resize(contour.size(), -1);
    for (size_t i = contour.size(); i-- > 0;) {
      int& first = first_[Index(contour[i])];
      next_[i] = std::exchange(first, static_cast<int>(i));
    }
  }
  /// The first place at `vertex` where the contour goes on with `heading`, or −1.
  [[nodiscard]] int Find(const std::vector<GridVertex>& contour, const GridVertex& vertex,
                         GridHeading heading) const {
    for (int i = first_[Index(vertex)]; i >= 0; i = next_[static_cast<size_t>(i)]) {
      const GridVertex& next = contour[(static_cast<size_t>(i) + 1) % contour.size()];
      if (next == Moved(vertex, heading)) return i;
    }
    return -1;
  }

 private:
  [[nodiscard]] size_t Index(const GridVertex& vertex) const {
    return static_cast<size_t>(vertex.row * cols_ + vertex.col);
  }
  int cols_;
  std::vector<int> first_, next_;
};

class AnchorFinder {
 public:
  AnchorFinder(const AnchorScene& scene, const PaperOptions& options)
      : scene_(scene),
        field_(scene.field),
        options_(options),
        contour_index_(field_.frame, scene.contour) {}

  std::vector<WallAnchor> Find() {
    std::vector<WallAnchor> anchors;
    for (const Candidate& candidate : FindCandidates(field_, options_)) {
      for (const WallAnchor& anchor : FacesOf(candidate)) {
        const bool is_near =
            std::any_of(anchors.begin(), anchors.end(),
                        [&](const WallAnchor& other) { return IsTooNear(anchor, other); });
        if (!is_near && IsVisible(anchor)) anchors.push_back(anchor);
      }
    }
    return InOrder(std::move(anchors));
  }

 private:
  [[nodiscard]] double CellM() const { return field_.frame.cell_m; }
  [[nodiscard]] bool IsVertex(const GridVertex& v) const {
    return v.row > 0 && v.col > 0 && v.row < field_.frame.rows && v.col < field_.frame.cols;
  }
  [[nodiscard]] Vector2d PositionOf(const GridVertex& v) const {
    return field_.frame.origin + CellM() * Vector2d(v.col, v.row);
  }

  /// The faces of the candidate's wall before which the region's contour runs.
  [[nodiscard]] std::vector<WallAnchor> FacesOf(const Candidate& candidate) const {
    std::vector<WallAnchor> faces;
    const GridVertex vertex = VertexOf(candidate);
    const auto headings = candidate.is_horizontal
                              ? std::array{GridHeading::kEast, GridHeading::kWest}
                              : std::array{GridHeading::kNorth, GridHeading::kSouth};
    for (const GridHeading heading : headings) {
      WallAnchor anchor{vertex, heading, candidate.points, candidate.support_m, 0};
      if (!IsOutsideFirst(anchor)) continue;
      const std::optional<std::pair<int, int>> place = PlaceOnContour(anchor);
      if (!place) continue;
      anchor.contour_idx = static_cast<size_t>(place->first);
      faces.push_back(anchor);
      if (faces.size() == 2) {  // a sheet with free space on both sides: the nearer one
        const int first_steps = PlaceOnContour(faces[0])->second;
        faces.erase(place->second < first_steps ? faces.begin() : faces.begin() + 1);
      }
    }
    return faces;
  }

  /// The vertex on the wall's line: the mean of its points across it.
  [[nodiscard]] GridVertex VertexOf(const Candidate& candidate) const {
    const bool is_horizontal = candidate.is_horizontal;
    const int half = static_cast<int>(std::lround(0.5 * options_.anchor_support_m / CellM()));
    double sum = 0, moment = 0;
    for (int t = -1; t <= 1; ++t) {
      for (int s = -half; s <= half; ++s) {
        const int row = candidate.row + (is_horizontal ? t : s);
        const int col = candidate.col + (is_horizontal ? s : t);
        if (!field_.frame.IsInside(row, col)) continue;
        sum += field_.wall(row, col);
        moment += t * field_.wall(row, col);
      }
    }
    const int shift = static_cast<int>(std::lround(moment / sum + 0.5));
    return is_horizontal ? GridVertex{candidate.row + shift, candidate.col}
                         : GridVertex{candidate.row, candidate.col + shift};
  }

  /// Not in the first path's interior, but for the little by which it may run behind its wall.
  [[nodiscard]] bool IsOutsideFirst(const WallAnchor& anchor) const {
    if (!IsVertex(anchor.vertex)) return false;
    const int cells = static_cast<int>(std::lround(kBeside_m / CellM()));
    const GridVertex cell =
        RightCell(Moved(anchor.vertex, TurnedRight(anchor.heading), cells), anchor.heading);
    return !field_.frame.IsInside(cell.row, cell.col) ||
           scene_.inside_first(cell.row, cell.col) == 0;
  }

  /// Place and distance of the contour straight before the wall, or behind it where free space
  /// leaks through; in the wall's own direction, so that the other face of a thin wall is no place.
  [[nodiscard]] std::optional<std::pair<int, int>> PlaceOnContour(const WallAnchor& anchor) const {
    const int reach = static_cast<int>(std::lround(options_.anchor_reach_m / CellM()));
    bool is_open[2] = {true, true};
    for (int steps = 0; steps <= reach; ++steps) {
      for (const bool is_before : {true, false}) {
        if (!is_open[is_before]) continue;
        const GridVertex vertex =
            Moved(anchor.vertex, TurnedLeft(anchor.heading), is_before ? steps : -steps);
        is_open[is_before] = IsVertex(vertex) && !IsCoreAt(vertex);
        if (!is_open[is_before]) continue;
        const int place = contour_index_.Find(scene_.contour, vertex, anchor.heading);
        if (place >= 0) return std::pair{place, steps};
      }
    }
    return std::nullopt;
  }

  /// True when all cells round the vertex are core: no loop passes there.
  [[nodiscard]] bool IsCoreAt(const GridVertex& v) const {
    const ImageU8& core = scene_.core;
    return core(v.row, v.col) != 0 && core(v.row - 1, v.col) != 0 && core(v.row, v.col - 1) != 0 &&
           core(v.row - 1, v.col - 1) != 0;
  }

  [[nodiscard]] bool IsTooNear(const WallAnchor& a, const WallAnchor& b) const {
    if (a.heading == Reversed(b.heading)) return false;
    return (PositionOf(a.vertex) - PositionOf(b.vertex)).norm() < options_.anchor_spacing_m;
  }

  /// Some camera before the wall sees it: no other wall on the way, and most of it known to be
  /// free.
  [[nodiscard]] bool IsVisible(const WallAnchor& anchor) const {
    const GridHeading into_room = TurnedLeft(anchor.heading);
    const auto h = static_cast<size_t>(into_room);
    const Vector2d normal(kColStep[h], kRowStep[h]);
    const Vector2d target = PositionOf(anchor.vertex) + kSightMargin_m * normal;
    return std::any_of(
        scene_.cameras.begin(), scene_.cameras.end(), [&](const EvidenceCamera& camera) {
          return normal.dot(camera.position - target) > 0 && IsClear(camera.position, target);
        });
  }

  [[nodiscard]] bool IsClear(const Vector2d& from, const Vector2d& to) const {
    int num_cells = 0, num_free = 0;
    bool is_clear = true;
    TraverseCells(field_.frame, from, to, [&](int row, int col) {
      ++num_cells;
      num_free += field_.rays(row, col) >= 1;
      is_clear = !field_.IsSeen(row, col);
      return is_clear;
    });
    return is_clear && num_free >= kMinFreeShare * num_cells;
  }

  /// In the order of the contour; of those at one place the strongest.
  [[nodiscard]] static std::vector<WallAnchor> InOrder(std::vector<WallAnchor> anchors) {
    std::sort(anchors.begin(), anchors.end(), [](const WallAnchor& a, const WallAnchor& b) {
      return std::tuple(a.contour_idx, -a.points) < std::tuple(b.contour_idx, -b.points);
    });
    const auto same_place = [](const WallAnchor& a, const WallAnchor& b) {
      return a.contour_idx == b.contour_idx;
    };
    anchors.erase(std::unique(anchors.begin(), anchors.end(), same_place), anchors.end());
    return anchors;
  }

  const AnchorScene& scene_;
  const PaperField& field_;
  const PaperOptions& options_;
  ContourIndex contour_index_;
};

}  // namespace

std::vector<WallAnchor> FindAnchors(const AnchorScene& scene, const PaperOptions& options) {
  return AnchorFinder(scene, options).Find();
}

std::vector<WallAnchor> ValidateAnchors(const AnchorScene& scene,
                                        const std::vector<WallAnchor>& anchors) {
  const PaperField& field = scene.field;
  std::vector<WallAnchor> kept = anchors;
  const LegSolver legs(field, scene.core, scene.foreign);
  const auto cost = [&](size_t a, size_t b) {
    return legs.Cost({kept[a].vertex, kept[a].heading}, {kept[b].vertex, kept[b].heading});
  };
  // What is saved without anchor i, in excess of what is allowed.
  const auto excess = [&](size_t i) {
    const size_t n = kept.size(), before = (i + n - 1) % n, after = (i + 1) % n;
    const int64_t with = cost(before, i) + cost(i, after);
    const int64_t allowed = 3 * int64_t{field.turn_cost} +
                            std::lround(kept[i].support_m / field.frame.cell_m * kCostPerCell);
    return with - cost(before, after) - allowed;
  };
  std::vector<int64_t> excesses;
  if (kept.size() < 3) return kept;
  for (size_t i = 0; i < kept.size(); ++i) excesses.push_back(excess(i));
  while (kept.size() >= 3) {
    const auto worst = std::max_element(excesses.begin(), excesses.end());
    if (*worst <= 0) break;
    const auto i = worst - excesses.begin();
    kept.erase(kept.begin() + i);
    excesses.erase(worst);
    if (kept.size() < 3) break;
    const size_t n = kept.size(), after = static_cast<size_t>(i) % n, before = (after + n - 1) % n;
    excesses[before] = excess(before);
    excesses[after] = excess(after);
  }
  return kept;
}

std::vector<GridVertex> MakeGuide(const std::vector<GridVertex>& contour,
                                  const std::vector<WallAnchor>& anchors,
                                  std::vector<int>& anchor_idx) {
  std::vector<GridVertex> guide;
  anchor_idx.clear();
  size_t next_anchor = 0;
  for (size_t i = 0; i < contour.size(); ++i) {
    const GridVertex& before = contour[(i + contour.size() - 1) % contour.size()];
    const GridVertex& at = contour[i];
    const GridVertex& after = contour[(i + 1) % contour.size()];
    const bool is_corner = (before.row == at.row) != (at.row == after.row);
    const bool has_anchor = next_anchor < anchors.size() && anchors[next_anchor].contour_idx == i;
    if (is_corner || has_anchor) guide.push_back(at);
    if (!has_anchor) continue;
    const GridVertex& vertex = anchors[next_anchor++].vertex;
    if (!(vertex == at)) guide.push_back(vertex);
    anchor_idx.push_back(static_cast<int>(guide.size()) - 1);
    if (!(vertex == at)) guide.push_back(at);
  }
  return guide;
}

}  // namespace enfilade
