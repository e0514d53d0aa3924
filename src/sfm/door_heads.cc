// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/door_heads.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

constexpr double kMaxLean_rad = DegToRad(1);
constexpr double kSameAzimuth_rad = DegToRad(0.6);
constexpr double kMaxGap_rad = DegToRad(3);
// An edge that ends lower than this does not show where it stands on the floor.
constexpr double kMinDepth_rad = DegToRad(12);
constexpr double kMinTop = 0.02;

constexpr double kLowest = 1.05, kBin = 0.01;  // camera heights
constexpr int kNumBins = 75;
constexpr int kReach = 2;
constexpr double kMaxOfOnePanorama = 3;
constexpr double kMinEdges = 6;
constexpr double kUsualSigma = 0.10;
constexpr double kEvidence = 2;  // how much twice the edges weigh beside what is usual
// A casing is 6 to 10 cm wide; its two edges have about as many ends.
constexpr double kCasingLow = 0.93, kCasingHigh = 0.975;
constexpr double kCasingShare = 0.8;

using Histogram = std::array<double, kNumBins>;

double HeightOfBin(int bin) { return kLowest + (bin + 0.5) * kBin; }

// How many edges end at each height, within a few bins.
Histogram CountEnds(std::span<const UprightEdge> edges) {
  Histogram counts{};
  for (const UprightEdge& edge : edges) {
    if (edge.bottom > -std::tan(kMinDepth_rad) || edge.top < kMinTop) continue;
    const double height = 1 - edge.top / edge.bottom;
    if (height > kLowest + (kNumBins + kReach) * kBin) continue;
    const int center = static_cast<int>(std::floor((height - kLowest) / kBin));
    for (int bin = std::max(0, center - kReach); bin <= std::min(kNumBins - 1, center + kReach);
         ++bin) {
      counts[static_cast<size_t>(bin)] += 1;
    }
  }
  return counts;
}

int MostLikelyBin(const Histogram& counts, double usual) {
  int best = 0;
  double best_score = -INFINITY;
  for (int bin = 0; bin < kNumBins; ++bin) {
    const double count = counts[static_cast<size_t>(bin)];
    if (count <= 0) continue;
    const double off = std::log(HeightOfBin(bin) / usual) / kUsualSigma;
    const double score = kEvidence * std::log(count) - 0.5 * off * off;
    if (score > best_score) {
      best = bin;
      best_score = score;
    }
  }
  return best;
}

// The lower edge of the casing whose upper one is at `bin`, or `bin`.
int InnerEdge(const Histogram& counts, int bin) {
  int best = bin;
  double most = kCasingShare * counts[static_cast<size_t>(bin)];
  for (int lower = 0; lower < bin; ++lower) {
    const double ratio = HeightOfBin(lower) / HeightOfBin(bin);
    if (ratio < kCasingLow || ratio > kCasingHigh) continue;
    if (counts[static_cast<size_t>(lower)] < most) continue;
    best = lower;
    most = counts[static_cast<size_t>(lower)];
  }
  return best;
}

bool Continues(const UprightEdge& edge, const UprightEdge& next) {
  return std::abs(WrapPi(next.azimuth_rad - edge.azimuth_rad)) < kSameAzimuth_rad &&
         std::atan(next.bottom) - std::atan(edge.top) < kMaxGap_rad && next.top > edge.top;
}

}  // namespace

std::vector<UprightEdge> UprightEdges(std::span<const LineSegment> segments,
                                      const Eigen::Matrix3d& level_from_cam) {
  std::vector<UprightEdge> pieces;
  for (const LineSegment& segment : segments) {
    const Vector3d a = level_from_cam * segment.from, b = level_from_cam * segment.to;
    if (std::abs(a.cross(b).normalized().z()) > std::sin(kMaxLean_rad)) continue;
    const Vector3d middle = a + b;
    const double end_a = a.z() / std::hypot(a.x(), a.y());
    const double end_b = b.z() / std::hypot(b.x(), b.y());
    pieces.push_back(
        {std::atan2(middle.y(), middle.x()), std::min(end_a, end_b), std::max(end_a, end_b)});
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const UprightEdge& x, const UprightEdge& y) { return x.bottom < y.bottom; });
  std::vector<UprightEdge> edges;
  std::vector<bool> is_used(pieces.size(), false);
  for (size_t i = 0; i < pieces.size(); ++i) {
    if (is_used[i]) continue;
    edges.push_back(pieces[i]);
    for (size_t j = i + 1; j < pieces.size(); ++j) {
      if (is_used[j] || !Continues(edges.back(), pieces[j])) continue;
      edges.back().top = pieces[j].top;
      is_used[j] = true;
    }
  }
  return edges;
}

std::optional<double> FindDoorHead(std::span<const std::vector<UprightEdge>> edges_of_panoramas,
                                   double usual) {
  Histogram counts{};
  for (const std::vector<UprightEdge>& edges : edges_of_panoramas) {
    const Histogram own = CountEnds(edges);
    for (size_t bin = 0; bin < own.size(); ++bin) {
      counts[bin] += std::min(kMaxOfOnePanorama, own[bin]);
    }
  }
  const int bin = InnerEdge(counts, MostLikelyBin(counts, usual));
  const double num_panoramas = static_cast<double>(edges_of_panoramas.size());
  if (counts[static_cast<size_t>(bin)] < std::max(kMinEdges, num_panoramas)) return std::nullopt;
  return HeightOfBin(bin);
}

}  // namespace enfilade
