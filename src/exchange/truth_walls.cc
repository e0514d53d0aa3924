// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "enfilade/geometry/angles.h"
#include "enfilade/geometry/cross.h"
#include "src/exchange/truth_sources.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kMaxGapAngle_deg = 20;
constexpr double kMinWall_m = 0.01;
constexpr double kSameDoor_m = 0.4;

// The stretches of the edge a→b that gaps cover, in metres from a, ascending.
std::vector<std::pair<double, double>> CoveredStretches(const Vector2d& a, const Vector2d& b,
                                                        std::span<const TruthSegment> gaps,
                                                        double tolerance_m) {
  const double length = (b - a).norm();
  const Vector2d along = (b - a) / length;
  const double min_cos = std::cos(DegToRad(kMaxGapAngle_deg));
  std::vector<std::pair<double, double>> stretches;
  for (const auto& [p, q] : gaps) {
    const bool is_near = std::abs(Cross(along, p - a)) <= tolerance_m &&
                         std::abs(Cross(along, q - a)) <= tolerance_m;
    const bool is_parallel = std::abs(along.dot(q - p)) >= min_cos * (q - p).norm();
    if (!is_near || !is_parallel) continue;
    auto [from, to] = std::minmax({along.dot(p - a), along.dot(q - a)});
    from = std::max(from, 0.0);
    to = std::min(to, length);
    if (from < to) stretches.emplace_back(from, to);
  }
  std::sort(stretches.begin(), stretches.end());
  return stretches;
}

void AppendUncovered(const Vector2d& a, const Vector2d& b, std::span<const TruthSegment> gaps,
                     double tolerance_m, std::vector<TruthSegment>& walls) {
  const double length = (b - a).norm();
  if (length < kMinWall_m) return;
  const Vector2d along = (b - a) / length;
  const auto append = [&](double from, double to) {
    if (to - from >= kMinWall_m) walls.push_back({a + from * along, a + to * along});
  };
  double done = 0;
  for (const auto& [from, to] : CoveredStretches(a, b, gaps, tolerance_m)) {
    append(done, from);
    done = std::max(done, to);
  }
  append(done, length);
}

}  // namespace

std::vector<TruthSegment> CutGaps(const MultiPolygon2& region, std::span<const TruthSegment> gaps,
                                  double tolerance_m) {
  std::vector<TruthSegment> walls;
  const auto cut_ring = [&](const Ring2& ring) {
    for (size_t i = 0; i < ring.size(); ++i) {
      AppendUncovered(ring[i], ring[(i + 1) % ring.size()], gaps, tolerance_m, walls);
    }
  };
  for (const Polygon2& polygon : region) {
    cut_ring(polygon.outer);
    for (const Ring2& hole : polygon.holes) cut_ring(hole);
  }
  return walls;
}

std::vector<TruthSegment> MergeDoors(std::span<const TruthSegment> doors) {
  const auto center = [&](size_t i) { return Vector2d(0.5 * (doors[i][0] + doors[i][1])); };
  std::vector<TruthSegment> merged;
  std::vector<bool> is_taken(doors.size(), false);
  for (size_t first = 0; first < doors.size(); ++first) {
    if (is_taken[first]) continue;
    is_taken[first] = true;
    std::vector<size_t> cluster{first};
    for (size_t k = 0; k < cluster.size(); ++k) {
      for (size_t i = first + 1; i < doors.size(); ++i) {
        if (is_taken[i] || (center(i) - center(cluster[k])).norm() > kSameDoor_m) continue;
        is_taken[i] = true;
        cluster.push_back(i);
      }
    }
    TruthSegment mean{Vector2d::Zero(), Vector2d::Zero()};
    const Vector2d along = doors[first][1] - doors[first][0];
    for (const size_t i : cluster) {
      const bool is_reversed = along.dot(doors[i][1] - doors[i][0]) < 0;
      mean[0] += doors[i][is_reversed ? 1 : 0] / static_cast<double>(cluster.size());
      mean[1] += doors[i][is_reversed ? 0 : 1] / static_cast<double>(cluster.size());
    }
    merged.push_back(mean);
  }
  return merged;
}

}  // namespace enfilade
