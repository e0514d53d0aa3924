// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/wall_witness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "enfilade/base/median.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/geometry/cross.h"
#include "enfilade/geometry/polygon2.h"
#include "src/floorplan/box_index.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kOpeningReach_m = 0.45;  // openings lie on one face, the other is as far away
constexpr double kJamb_m = 0.02;
constexpr double kTouch_m = 1e-6;

// Where a ray meets the segment a → b: the distance along the unit direction, if it does.
std::optional<double> MeetSegment(const Vector2d& origin, const Vector2d& direction,
                                  const Vector2d& a, const Vector2d& b) {
  const Vector2d edge = b - a;
  const double determinant = Cross(direction, edge);
  if (std::abs(determinant) < 1e-12) return std::nullopt;
  const double along = Cross(a - origin, direction) / determinant;
  const double distance = Cross(a - origin, edge) / determinant;
  if (along < 0 || along > 1 || distance <= kTouch_m) return std::nullopt;
  return distance;
}

bool IsInOpening(const Opening& opening, const Vector2d& p) {
  const Vector2d span = opening.b - opening.a;
  const double width = span.norm(), along = span.dot(p - opening.a) / width;
  return along > -kJamb_m && along < width + kJamb_m &&
         std::abs(Cross(span, p - opening.a)) / width < kOpeningReach_m;
}

// Of every wall the doors and openings that may be in it.
std::vector<std::vector<const Opening*>> OpeningsOfWalls(const Storey& storey) {
  std::vector<const Opening*> passages;
  std::vector<Box2> boxes;
  for (const Opening& opening : storey.openings) {
    if (opening.kind == OpeningKind::kWindow || (opening.b - opening.a).norm() < kJamb_m) continue;
    passages.push_back(&opening);
    boxes.push_back(Grown(BoxOf(opening.a, opening.b), kOpeningReach_m + kJamb_m));
  }
  const BoxIndex index(std::move(boxes));
  std::vector<std::vector<const Opening*>> of_walls;
  for (const Wall& wall : storey.walls) {
    const Vector2d along = (wall.b - wall.a).normalized();
    std::vector<const Opening*>& of_wall = of_walls.emplace_back();
    for (const size_t i : index.Touching(BoxOf(wall.a, wall.b))) {
      const Vector2d span = passages[i]->b - passages[i]->a;
      if (std::abs(span.dot(along)) >= 0.99 * span.norm()) of_wall.push_back(passages[i]);
    }
  }
  return of_walls;
}

// For every column of a panorama the walls that its ray may meet: those in its direction, and a
// column more on either side for rounding.
std::vector<std::vector<size_t>> WallsByColumn(const std::vector<Wall>& walls,
                                               const Vector2d& camera, int num_columns) {
  std::vector<std::vector<size_t>> in_column(static_cast<size_t>(num_columns));
  const double columns_per_rad = num_columns / (2 * kPi);
  const auto azimuth_of = [&](const Vector2d& p) {
    return std::atan2(p.y() - camera.y(), p.x() - camera.x());
  };
  for (size_t i = 0; i < walls.size(); ++i) {
    const double a = azimuth_of(walls[i].a), turn = WrapPi(azimuth_of(walls[i].b) - a);
    const double begin = (std::min(a, a + turn) + kPi) * columns_per_rad - 0.5;
    const int first = static_cast<int>(std::floor(begin)) - 1;
    const int last = static_cast<int>(std::ceil(begin + std::abs(turn) * columns_per_rad)) + 1;
    for (int c = first; c <= std::min(last, first + num_columns - 1); ++c)
      in_column[static_cast<size_t>((c % num_columns + num_columns) % num_columns)].push_back(i);
  }
  return in_column;
}

struct Hit {
  size_t wall_idx = 0;
  double distance_m = 0;
};

// Of some walls the first face on the ray that is no opening; none when it is seen from behind.
std::optional<Hit> FirstWall(const std::vector<Wall>& walls, const std::vector<size_t>& ahead,
                             const std::vector<std::vector<const Opening*>>& openings,
                             const Vector2d& origin, const Vector2d& direction) {
  std::vector<Hit> hits;
  for (const size_t i : ahead) {
    const Wall& wall = walls[i];
    const std::optional<double> distance = MeetSegment(origin, direction, wall.a, wall.b);
    if (distance) hits.push_back({i, *distance});
  }
  std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) {
    return a.distance_m != b.distance_m ? a.distance_m < b.distance_m : a.wall_idx < b.wall_idx;
  });
  for (const Hit& hit : hits) {
    const Wall& wall = walls[hit.wall_idx];
    const Vector2d along = (wall.b - wall.a).normalized();
    const std::vector<const Opening*>& of_wall = openings[hit.wall_idx];
    const bool is_opening =
        std::any_of(of_wall.begin(), of_wall.end(), [&](const Opening* opening) {
          return IsInOpening(*opening, origin + hit.distance_m * direction);
        });
    if (is_opening) continue;
    // The room lies on the left of a → b, so a ray from within crosses from left to right.
    if (Cross(along, direction) < 0) return hit;
    return std::nullopt;
  }
  return std::nullopt;
}

template <typename Function>
double MedianOver(const std::vector<WallSighting>& sightings, const Function& function) {
  std::vector<double> values;
  values.reserve(sightings.size());
  for (const WallSighting& sighting : sightings) values.push_back(function(sighting));
  return UpperMedian(std::move(values));
}

void Summarise(const Vector2d& camera, const Wall& wall, WallWitness& witness) {
  const Vector2d along = (wall.b - wall.a).normalized();
  const std::vector<WallSighting>& all = witness.sightings;
  witness.distance_m = std::abs(Cross(along, camera - wall.a));
  witness.range_m = MedianOver(all, [](const WallSighting& s) { return s.distance_m; });
  witness.incidence_rad = MedianOver(all, [](const WallSighting& s) { return s.incidence_rad; });
  witness.offset_m = MedianOver(all, [](const WallSighting& s) {
    return (s.profile_m - s.distance_m) * std::cos(s.incidence_rad);
  });
  witness.agreeing_share = static_cast<double>(std::count_if(all.begin(), all.end(), Agrees)) /
                           static_cast<double>(all.size());
}

}  // namespace

bool Agrees(const WallSighting& sighting) {
  return std::abs(sighting.profile_m - sighting.distance_m) <= kAgreement * sighting.distance_m;
}

std::vector<std::vector<WallWitness>> FindWallWitnesses(const Scene& scene,
                                                        const Structure& structure,
                                                        const Storey& storey, int storey_idx) {
  std::vector<std::vector<WallWitness>> witnesses(storey.walls.size());
  const std::vector<std::vector<const Opening*>> openings = OpeningsOfWalls(storey);
  for (const WallProfile& profile : structure.profiles) {
    const View& view = scene.views[static_cast<size_t>(profile.view_idx)];
    if (view.storey_idx != storey_idx) continue;
    const Vector2d camera = (structure.home_from_world * view.world_from_cam.translation).head<2>();
    const std::vector<std::vector<size_t>> ahead =
        WallsByColumn(storey.walls, camera, profile.num_columns());
    for (int column = 0; column < profile.num_columns(); ++column) {
      const auto c = static_cast<size_t>(column);
      if (profile.is_seen[c] == 0) continue;
      const double azimuth = AzimuthOfColumn(column, profile.num_columns());
      const Vector2d direction(std::cos(azimuth), std::sin(azimuth));
      const std::optional<Hit> hit = FirstWall(storey.walls, ahead[c], openings, camera, direction);
      if (!hit) continue;
      std::vector<WallWitness>& of_wall = witnesses[hit->wall_idx];
      if (of_wall.empty() || of_wall.back().view_idx != profile.view_idx)
        of_wall.push_back({.view_idx = profile.view_idx, .sightings = {}});
      const Wall& wall = storey.walls[hit->wall_idx];
      const Vector2d along = (wall.b - wall.a).normalized();
      const Vector2d end = camera + hit->distance_m * direction;
      of_wall.back().sightings.push_back({along.dot(end - wall.a), hit->distance_m,
                                          std::asin(std::min(1.0, std::abs(along.dot(direction)))),
                                          static_cast<double>(profile.wall_m[c])});
    }
    for (size_t i = 0; i < witnesses.size(); ++i) {
      if (!witnesses[i].empty() && witnesses[i].back().view_idx == profile.view_idx)
        Summarise(camera, storey.walls[i], witnesses[i].back());
    }
  }
  return witnesses;
}

}  // namespace enfilade
