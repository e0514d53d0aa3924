// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/ring_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

namespace enfilade {
namespace {

using Eigen::Vector2d;

std::optional<double> Free(const RingCorner& /*corner*/) { return 1.0; }

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Prices of corners by the walls that they join; nothing for a quarter of them.
class RandomPrices {
 public:
  explicit RandomPrices(uint32_t seed) : random_(seed) {}
  std::optional<double> operator()(size_t from, size_t to) {
    const auto [entry, is_new] = prices_.try_emplace({from, to});
    if (is_new && random_() % 4 != 0) entry->second = 0.25 * static_cast<double>(random_() % 40);
    return entry->second;
  }

 private:
  std::mt19937 random_;
  std::map<std::pair<size_t, size_t>, std::optional<double>> prices_;
};

// A rectangle with bays, niches and cut corners.
Ring2 RandomRing(std::mt19937& random, size_t least_walls) {
  Ring2 ring = ParseRing("0,0 6,0 6,5 0,5");
  const auto number = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<uint32_t>(high - low + 1));
  };
  for (int tries = 0; ring.size() < least_walls && tries < 1000; ++tries) {
    const size_t n = ring.size(), i = random() % n;
    const Vector2d a = ring[i], b = ring[(i + 1) % n], along = (b - a).normalized();
    const Vector2d normal(-along.y(), along.x());
    const double length = (b - a).norm();
    if (length < 1) continue;
    Ring2 next = ring;
    const auto at = next.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    if (number(0, 3) == 0) {  // instead of the corner at b an oblique wall
      const Vector2d c = ring[(i + 2) % n];
      const size_t j = (i + 1) % n;
      if ((c - b).norm() < 1) continue;
      next[j] = b - 0.5 * along;
      next.insert(next.begin() + static_cast<std::ptrdiff_t>(j) + 1,
                  b + 0.5 * (c - b).normalized());
    } else {
      const double begin = 0.1 * number(1, static_cast<int>(5 * length) - 2);
      const double end = begin + 0.1 * number(2, static_cast<int>(4 * length));
      if (end > length - 0.1) continue;
      const Vector2d depth = 0.1 * (number(0, 1) == 0 ? -1 : 1) * number(1, 12) * normal;
      const std::vector<Vector2d> bay = {a + begin * along, a + begin * along + depth,
                                         a + end * along + depth, a + end * along};
      next.insert(at, bay.begin(), bay.end());
    }
    if (IsSimple(next)) ring = next;
  }
  return ring;
}

// Rounding may hide a touch from IsSimple.
bool TouchesItself(const Ring2& ring) {
  const size_t n = ring.size();
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j < n; ++j) {
      if (j != i && (j + 1) % n != i &&
          DistanceToSegment(ring[i], ring[j], ring[(j + 1) % n]) < 1e-4)
        return true;
    }
  }
  return false;
}

// The cheapest cost for every number of walls, by trying all subsets of walls.
std::map<size_t, double> CheapestOfAllSubsets(const Ring2& ring, RandomPrices& prices) {
  const size_t n = ring.size();
  std::map<size_t, double> best;
  for (uint32_t set = 0; set < (1U << n); ++set) {
    std::vector<size_t> walls;
    for (size_t i = 0; i < n; ++i) {
      if ((set >> i & 1U) != 0) walls.push_back(i);
    }
    const size_t k = walls.size();
    if (k < 3) continue;
    Ring2 corners;  // at the start of each wall
    double cost = 0;
    bool is_possible = true;
    for (size_t m = 0; m < k && is_possible; ++m) {
      const size_t from = walls[(m + k - 1) % k], to = walls[m];
      const Vector2d a = ring[from], in = ring[(from + 1) % n] - a, b = ring[to],
                     out = ring[(to + 1) % n] - b;
      if ((from + 1) % n == to) {
        corners.push_back(b);
        continue;
      }
      const double sine = Cross(in, out) / (in.norm() * out.norm());
      is_possible = std::abs(sine) >= 0.15;
      if (!is_possible) break;
      corners.emplace_back(a + Cross(b - a, out) / Cross(in, out) * in);
      const std::optional<double> price = prices(from, to);
      is_possible = price.has_value();
      cost += price.value_or(0);
    }
    if (!is_possible) continue;
    for (size_t m = 0; m < k; ++m) {  // enough of each wall
      const Vector2d a = ring[walls[m]], wall = ring[(walls[m] + 1) % n] - a;
      const double length = wall.norm();
      const double begin = wall.dot(corners[m] - a) / length,
                   end = wall.dot(corners[(m + 1) % k] - a) / length;
      if (std::min(end, length) - std::max(begin, 0.0) < std::min(0.05, length) - 1e-6)
        is_possible = false;
    }
    if (!is_possible || !IsSimple(corners) || TouchesItself(corners) || SignedArea(corners) <= 0)
      continue;
    const auto [entry, is_new] = best.try_emplace(k, cost);
    entry->second = std::min(entry->second, cost);
  }
  return best;
}

TEST(RingCurve, ABayIsLeftOutAndTheRingItselfIsTheLast) {
  const Ring2 ring = ParseRing("0,0 4,0 4,3 3,3 3,4 1,4 1,3 0,3");
  const std::vector<SimplerRing> rings = FindSimplerRings(ring, Free);
  ASSERT_EQ(rings.size(), 2U) << "six walls cost as much as four";
  EXPECT_EQ(rings[0].ring.size(), 4U);
  EXPECT_EQ(SignedArea(rings[0].ring), 12);
  EXPECT_EQ(rings[0].cost, 1);
  EXPECT_EQ(rings[1].ring, ring);
  EXPECT_EQ(rings[1].cost, 0);
}

TEST(RingCurve, TheWalkOfACornerGoesRoundWhatItChanges) {
  const Ring2 ring = ParseRing("0,0 4,0 4,3 3,3 3,4 1,4 1,3 0,3");
  std::map<std::pair<size_t, size_t>, double> area;
  (void)FindSimplerRings(ring, [&](const RingCorner& corner) {
    area[{corner.from, corner.to}] = SignedArea(corner.change);
    return std::optional(1.0);
  });
  EXPECT_EQ((area[{2, 7}]), -2) << "the bay goes";
  EXPECT_EQ((area[{1, 4}]), 1) << "a corner is filled";
}

TEST(RingCurve, ObliqueWallsGoOneByOne) {
  const std::vector<SimplerRing> rings = FindSimplerRings(
      ParseRing("0,0 4,0 4,3 3,4 0,4"),
      [](const RingCorner& corner) { return std::optional(std::abs(SignedArea(corner.change))); });
  ASSERT_EQ(rings.size(), 3U);
  EXPECT_EQ(rings[0].ring.size(), 3U) << "the oblique wall with two others";
  EXPECT_EQ(rings[1].ring.size(), 4U);
  EXPECT_EQ(SignedArea(rings[1].ring), 16);
  EXPECT_EQ(rings[1].cost, 0.5);
}

TEST(RingCurve, CostsAreThoseOfTheBestOfAllSubsets) {
  std::mt19937 random(7);
  int num_compared = 0, num_oblique = 0;
  for (uint32_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const Ring2 ring = RandomRing(random, 5 + seed % 9);
    if (ring.size() > 14) continue;
    num_oblique += ring.size() % 2;
    RandomPrices prices(seed);
    const auto price = [&](const RingCorner& corner) { return prices(corner.from, corner.to); };
    std::map<size_t, double> found;
    for (const SimplerRing& simpler : FindSimplerRings(ring, price)) {
      found[simpler.ring.size()] = simpler.cost;
      EXPECT_TRUE(IsSimple(simpler.ring)) << RingToText(simpler.ring);
      ASSERT_EQ(simpler.wall_idx.size(), simpler.ring.size());
      for (size_t i = 0; i < simpler.ring.size(); ++i) {
        const Vector2d a = ring[simpler.wall_idx[i]],
                       b = ring[(simpler.wall_idx[i] + 1) % ring.size()];
        const Vector2d c = simpler.ring[i], d = simpler.ring[(i + 1) % simpler.ring.size()];
        EXPECT_NEAR(Cross((b - a).normalized(), c - a), 0, 1e-9);
        EXPECT_NEAR(Cross((b - a).normalized(), d - a), 0, 1e-9);
        EXPECT_GT((b - a).dot(d - c), 0);
      }
    }
    std::map<size_t, double> expected;
    for (const auto& [num_walls, cost] : CheapestOfAllSubsets(ring, prices)) {
      const bool is_cheaper = expected.empty() || cost < expected.rbegin()->second;
      if (is_cheaper || num_walls == ring.size()) expected[num_walls] = cost;
    }
    EXPECT_EQ(found, expected);
    num_compared += static_cast<int>(expected.size());
  }
  EXPECT_GT(num_compared, 900);
  EXPECT_GT(num_oblique, 50);
}

}  // namespace
}  // namespace enfilade
