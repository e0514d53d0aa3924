// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "src/synthetic/cameras.h"
#include "src/synthetic/standing_space.h"
#include "src/synthetic/storeys.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kCell_m = 0.1;
constexpr double kMinClearance_m = 0.33;
constexpr double kEasyClearance_m = 0.7;  // nearer to things one walks unwillingly
constexpr double kPerStop_m2 = 7;         // floor seen from one place on the way

// Free cells of the home's floor, each with what a step onto it costs.
struct WalkGrid {
  Vector2d origin{0, 0};
  int cols = 0, rows = 0;
  std::vector<float> cost;  ///< per metre; 0 where one cannot walk
  std::vector<int> room_id;

  [[nodiscard]] Vector2d Center(int cell) const {
    return origin + kCell_m * Vector2d(cell % cols + 0.5, cell / cols + 0.5);
  }
  [[nodiscard]] bool IsFree(int cell) const { return cost[static_cast<size_t>(cell)] > 0; }
  [[nodiscard]] int Size() const { return cols * rows; }
};

WalkGrid MakeGrid(const Home& home) {
  const Rectangle bounds = GroundOf(home);
  const StandingSpace space(home, 0);
  WalkGrid grid;
  grid.origin = bounds.min;
  grid.cols = static_cast<int>(bounds.Size().x() / kCell_m) + 1;
  grid.rows = static_cast<int>(bounds.Size().y() / kCell_m) + 1;
  for (int cell = 0; cell < grid.Size(); ++cell) {
    const Vector2d p = grid.Center(cell);
    const double clear_m = space.Clearance(p);
    const double want = std::max(0.0, kEasyClearance_m - clear_m) / kEasyClearance_m;
    grid.cost.push_back(clear_m < kMinClearance_m ? 0.0f : static_cast<float>(1 + 4 * want));
    grid.room_id.push_back(space.RoomAt(p).value_or(-1));
  }
  return grid;
}

// Cheapest ways from a cell to all others (Dijkstra 1959): cost, and the cell before.
struct Ways {
  std::vector<double> cost;
  std::vector<int> before;
};

Ways FindWays(const WalkGrid& grid, int start) {
  Ways ways;
  ways.cost.assign(static_cast<size_t>(grid.Size()), std::numeric_limits<double>::infinity());
  ways.before.assign(static_cast<size_t>(grid.Size()), -1);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  ways.cost[static_cast<size_t>(start)] = 0;
  queue.emplace(0, start);
  while (!queue.empty()) {
    const auto [cost, cell] = queue.top();
    queue.pop();
    if (cost > ways.cost[static_cast<size_t>(cell)]) continue;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = cell % grid.cols + dx, y = cell / grid.cols + dy;
        const int next = y * grid.cols + x;
        if (x < 0 || x >= grid.cols || y < 0 || y >= grid.rows || !grid.IsFree(next)) continue;
        const double reached =
            cost + grid.cost[static_cast<size_t>(next)] * kCell_m * std::hypot(dx, dy);
        if (reached >= ways.cost[static_cast<size_t>(next)]) continue;
        ways.cost[static_cast<size_t>(next)] = reached;
        ways.before[static_cast<size_t>(next)] = cell;
        queue.emplace(reached, next);
      }
    }
  }
  return ways;
}

// Cells of a room far from each other: the easiest one to stand on, then always the farthest from
// those there are (Gonzalez 1985).
std::vector<int> StopsIn(const WalkGrid& grid, const HomeRoom& room) {
  std::vector<int> cells;
  for (int cell = 0; cell < grid.Size(); ++cell) {
    if (grid.IsFree(cell) && grid.room_id[static_cast<size_t>(cell)] == room.id)
      cells.push_back(cell);
  }
  if (cells.empty()) return {};
  const auto wanted = static_cast<size_t>(std::max(1.0, Area(room.polygon) / kPerStop_m2));
  std::vector<int> stops = {*std::min_element(cells.begin(), cells.end(), [&](int a, int b) {
    return grid.cost[static_cast<size_t>(a)] < grid.cost[static_cast<size_t>(b)];
  })};
  while (stops.size() < wanted) {
    const auto apart_m = [&](int cell) {
      double nearest_m = std::numeric_limits<double>::infinity();
      for (const int stop : stops)
        nearest_m = std::min(nearest_m, (grid.Center(cell) - grid.Center(stop)).norm());
      return nearest_m;
    };
    stops.push_back(*std::max_element(cells.begin(), cells.end(),
                                      [&](int a, int b) { return apart_m(a) < apart_m(b); }));
  }
  return stops;
}

// A way past all stops, always to the nearest one left; empty when one cannot be reached.
std::vector<Vector2d> WalkPast(const WalkGrid& grid, std::vector<int> stops) {
  std::vector<Vector2d> path;
  int here = stops[0];
  stops.erase(stops.begin());
  while (!stops.empty()) {
    const Ways ways = FindWays(grid, here);
    const auto cost = [&](int cell) { return ways.cost[static_cast<size_t>(cell)]; };
    const auto nearest = std::min_element(stops.begin(), stops.end(),
                                          [&](int a, int b) { return cost(a) < cost(b); });
    if (!std::isfinite(cost(*nearest))) return {};
    std::vector<Vector2d> leg;
    for (int cell = *nearest; cell != here; cell = ways.before[static_cast<size_t>(cell)])
      leg.push_back(grid.Center(cell));
    path.insert(path.end(), leg.rbegin(), leg.rend());
    here = *nearest;
    stops.erase(nearest);
  }
  return path;
}

// Points of the path 0.4–0.5 m apart along it.
std::vector<Vector2d> Resample(const std::vector<Vector2d>& path, Random& random) {
  std::vector<Vector2d> points = {path[0]};
  double left_m = random.Uniform(0.4, 0.5);
  for (size_t i = 1; i < path.size(); ++i) {
    left_m -= (path[i] - path[i - 1]).norm();
    if (left_m > 0) continue;
    points.push_back(path[i]);
    left_m = random.Uniform(0.4, 0.5);
  }
  return points;
}

}  // namespace

bool PlaceWalkCameras(Home& home, Random& random) {
  const WalkGrid grid = MakeGrid(home);
  std::vector<int> stops;
  for (const HomeRoom& room : home.rooms) {
    const std::vector<int> own = StopsIn(grid, room);
    if (own.empty()) return false;
    stops.insert(stops.end(), own.begin(), own.end());
  }
  const std::vector<Vector2d> path = WalkPast(grid, stops);
  if (path.size() < 2) return false;
  const std::vector<Vector2d> points = Resample(path, random);
  const StandingSpace space(home, 0);
  const double height_m = random.Millimetres(1.5, 1.7);  // held up, or on a helmet
  for (size_t i = 0; i < points.size(); ++i) {
    const Vector2d ahead =
        i + 1 < points.size() ? points[i + 1] - points[i] : points[i] - points[i - 1];
    const double azimuth = std::atan2(ahead.y(), ahead.x()) + 0.1 * random.Normal();
    const int room_id = *space.RoomAt(points[i]);
    const double z = home.RoomById(room_id).floor_z + height_m + random.Uniform(-0.03, 0.03);
    AddCamera(home, room_id, {points[i].x(), points[i].y(), z}, azimuth);
  }
  return true;
}

}  // namespace enfilade
