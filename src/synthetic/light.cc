// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>

#include "enfilade/geometry/angles.h"
#include "src/synthetic/finish.h"
#include "src/synthetic/random.h"

namespace enfilade {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float kReflectedCells = 2.5f;  // size of the coarse cells in fine ones
constexpr float kLift_m = 1e-3f;         // rays start off the surface
constexpr float kCoveredWithin_m = 0.03f;
constexpr int kLampStrata = 5;  // squared: shadow rays to a lamp
constexpr int kWindowStrata = 7;
constexpr int kMaxStrata = std::max(kLampStrata, kWindowStrata);
constexpr int kSmoothings = 2;
constexpr float kPi_f = static_cast<float>(kPi);

// A rectangle that sends light to where its normal points.
struct AreaLight {
  Vector3f origin, edge_u, edge_v, normal;
  float area = 0;
  int strata = 1;
  bool is_window = false;
  int room_id = 0;
  Vector3f radiance{0, 0, 0};  ///< lamps

  /// Middle of cell (i, j) of strata × strata: the same points for every receiver give bands too
  /// faint to see instead of noise.
  [[nodiscard]] Vector3f Point(int i, int j) const {
    const auto n = static_cast<float>(strata);
    return origin + (static_cast<float>(i) + 0.5f) / n * edge_u +
           (static_cast<float>(j) + 0.5f) / n * edge_v;
  }
};

std::vector<AreaLight> CollectLights(const Home& home) {
  std::vector<AreaLight> lights;
  for (const HomeLamp& lamp : home.lamps) {
    AreaLight light;
    light.edge_u = Vector3f(static_cast<float>(lamp.size.x()), 0, 0);
    light.edge_v = Vector3f(0, static_cast<float>(lamp.size.y()), 0);
    light.origin = lamp.center.cast<float>() - 0.5f * (light.edge_u + light.edge_v);
    light.normal = -Vector3f::UnitZ();
    light.area = static_cast<float>(lamp.size.prod());
    light.strata = kLampStrata;
    light.radiance = lamp.radiance;
    light.room_id = lamp.room_id;
    lights.push_back(light);
  }
  for (const HomeOpening& opening : home.openings) {
    if (opening.other_room_id || opening.leaf == DoorLeaf::kClosed) continue;
    // The outer end of the hole: everything between it and the room casts shadows.
    const Eigen::Vector2d a = opening.a + opening.thickness_m * opening.IntoWall();
    const Eigen::Vector2d along = opening.b - opening.a, in = -opening.IntoWall();
    AreaLight light;
    light.origin = Eigen::Vector3d(a.x(), a.y(), opening.sill_z).cast<float>();
    light.edge_u = Eigen::Vector3d(along.x(), along.y(), 0).cast<float>();
    light.edge_v = Vector3f(0, 0, static_cast<float>(opening.head_z - opening.sill_z));
    light.normal = Eigen::Vector3d(in.x(), in.y(), 0).cast<float>();
    light.area = light.edge_u.norm() * light.edge_v.norm();
    light.strata = kWindowStrata;
    light.is_window = true;
    light.room_id = opening.room_id;
    lights.push_back(light);
  }
  return lights;
}

// The lights of a room and of those that an open door joins to it; through two doors hardly any
// comes.
std::vector<AreaLight> LightsFor(const Home& home, const std::vector<AreaLight>& lights,
                                 int room_id) {
  std::set<int> rooms = {room_id};
  for (const HomeOpening& opening : home.openings) {
    if (!opening.IsPassable()) continue;
    if (opening.room_id == room_id) rooms.insert(*opening.other_room_id);
    if (*opening.other_room_id == room_id) rooms.insert(opening.room_id);
  }
  std::vector<AreaLight> near;
  std::copy_if(lights.begin(), lights.end(), std::back_inserter(near),
               [&](const AreaLight& light) { return rooms.count(light.room_id) > 0; });
  return near;
}

// Radiance that the light sends along `direction` (from receiver to light), times its cosine.
Vector3f Emitted(const AreaLight& light, const Vector3f& direction) {
  const float cosine = -light.normal.dot(direction);
  if (light.is_window) return std::max(0.0f, cosine) * SkyRadiance(direction);
  // A dome of milk glass rather than a flat panel: some of its light goes sideways.
  return std::max(0.0f, 0.85f * cosine + 0.15f) * light.radiance;
}

enum class Visibility { kNone, kPart, kAll };

// Looks at a ninth of a light's points: most receivers see all of a light or nothing.
Visibility ProbeLight(const AreaLight& light, const RayScene& scene, const Vector3f& point) {
  const int middle = light.strata / 2, last = light.strata - 1;
  std::array<Vector3f, 9> targets;
  size_t n = 0;
  for (const int i : {0, middle, last}) {
    for (const int j : {0, middle, last}) targets[n++] = light.Point(i, j);
  }
  std::array<bool, 9> is_blocked;
  scene.FindBlocked(point, targets, is_blocked);
  const auto num_blocked = std::count(is_blocked.begin(), is_blocked.end(), true);
  return num_blocked == 9   ? Visibility::kNone
         : num_blocked == 0 ? Visibility::kAll
                            : Visibility::kPart;
}

Vector3f IrradianceFrom(const AreaLight& light, const RayScene& scene, const Vector3f& point,
                        const Vector3f& normal) {
  // The light's corners tell whether any of it lies before the surface.
  const Vector3f far_u = light.origin + light.edge_u, far_v = light.origin + light.edge_v;
  const float front =
      std::max({normal.dot(light.origin - point), normal.dot(far_u - point),
                normal.dot(far_v - point), normal.dot(far_u + light.edge_v - point)});
  if (front <= 0) return Vector3f::Zero();
  const Visibility visibility = ProbeLight(light, scene, point);
  if (visibility == Visibility::kNone) return Vector3f::Zero();
  std::array<Vector3f, kMaxStrata * kMaxStrata> targets, sent;
  size_t n = 0;
  for (int i = 0; i < light.strata; ++i) {
    for (int j = 0; j < light.strata; ++j) {
      const Vector3f target = light.Point(i, j), offset = target - point;
      const float squared = std::max(offset.squaredNorm(), 1e-4f);
      const Vector3f direction = offset / std::sqrt(squared);
      const float cosine = normal.dot(direction);
      if (cosine <= 0) continue;
      const Vector3f emitted = Emitted(light, direction);
      if (emitted.maxCoeff() <= 0) continue;
      targets[n] = target;
      sent[n++] = emitted * (cosine / squared);
    }
  }
  std::array<bool, kMaxStrata * kMaxStrata> is_blocked{};
  if (visibility == Visibility::kPart)
    scene.FindBlocked(point, std::span(targets).first(n), std::span(is_blocked).first(n));
  Vector3f sum(0, 0, 0);
  for (size_t k = 0; k < n; ++k) {
    if (!is_blocked[k]) sum += sent[k];
  }
  return sum * (light.area / static_cast<float>(light.strata * light.strata));
}

Vector3f DirectIrradiance(const std::vector<AreaLight>& lights, const RayScene& scene,
                          const Vector3f& point, const Vector3f& normal) {
  Vector3f sum(0, 0, 0);
  for (const AreaLight& light : lights) sum += IrradianceFrom(light, scene, point, normal);
  return sum;
}

// Cosine-distributed direction about the normal from two numbers in [0, 1).
Vector3f CosineDirection(const Surface& surface, float s, float t) {
  const float radius = std::sqrt(s), angle = 2 * kPi_f * t;
  return (radius * std::cos(angle) * surface.axis_u + radius * std::sin(angle) * surface.axis_v +
          std::sqrt(std::max(0.0f, 1 - s)) * surface.normal)
      .normalized();
}

// Reflected light that arrives at a point, from the sun and the light known so far. Windows and
// lamps count as dark: their light came directly.
Vector3f GatheredIrradiance(const Home& home, const std::vector<Surface>& surfaces,
                            const RayScene& scene, const BakedLight& light, const Surface& surface,
                            const Vector3f& point, int num_rays, Random& random) {
  const int strata = std::max(1, static_cast<int>(std::sqrt(static_cast<float>(num_rays))));
  Vector3f sum(0, 0, 0);
  for (int i = 0; i < strata * strata; ++i) {
    const float s = (static_cast<float>(i % strata) + static_cast<float>(random.Uniform())) /
                    static_cast<float>(strata);
    const float t = (static_cast<float>(i / strata) + static_cast<float>(random.Uniform())) /
                    static_cast<float>(strata);
    const Vector3f direction = CosineDirection(surface, s, t);
    const std::optional<RayHit> hit = scene.Trace(point, direction);
    if (!hit) continue;
    const Surface& other = surfaces[static_cast<size_t>(hit->surface_idx)];
    if (other.normal.dot(direction) >= 0) continue;
    const Vector3f there = point + hit->distance_m * direction;
    sum += other.rgb.cwiseProduct(light.IrradianceAt(*hit) +
                                  SunIrradiance(home, scene, there, other.normal)) /
           kPi_f;
  }
  return sum * (kPi_f / static_cast<float>(strata * strata));
}

bool ContainsPoint(const Surface& surface, const Vector2f& p) {
  const auto cross = [](const Vector2f& a, const Vector2f& b) {
    return a.x() * b.y() - a.y() * b.x();
  };
  return std::any_of(
      surface.triangles.begin(), surface.triangles.end(), [&](const std::array<int, 3>& t) {
        const Vector2f& a = surface.vertices[static_cast<size_t>(t[0])];
        const Vector2f& b = surface.vertices[static_cast<size_t>(t[1])];
        const Vector2f& c = surface.vertices[static_cast<size_t>(t[2])];
        const float x = cross(b - a, p - a), y = cross(c - b, p - b), z = cross(a - c, p - c);
        return (x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0);
      });
}

// Whether light can reach the cell's centre: not in a hole, inside a thing or covered by one within
// `cover_m`.
bool IsOpen(const std::vector<Surface>& surfaces, const RayScene& scene, const Surface& surface,
            const Vector2f& uv, float cover_m) {
  if (!ContainsPoint(surface, uv)) return false;
  const std::optional<RayHit> hit =
      scene.Trace(surface.Point(uv.x(), uv.y()) + kLift_m * surface.normal, surface.normal);
  if (!hit) return true;
  const bool is_from_inside =
      surfaces[static_cast<size_t>(hit->surface_idx)].normal.dot(surface.normal) > 0;
  return !is_from_inside && hit->distance_m > cover_m;
}

// Gives closed cells the mean of their filled neighbours, ring by ring.
void FillClosedCells(LightGrid& grid, std::vector<char>& is_filled) {
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    const std::vector<char> before = is_filled;
    for (int r = 0; r < grid.rows; ++r) {
      for (int c = 0; c < grid.cols; ++c) {
        if (before[grid.Index(r, c)] != 0) continue;
        Vector3f sum(0, 0, 0);
        float count = 0;
        for (int y = std::max(r - 1, 0); y <= std::min(r + 1, grid.rows - 1); ++y) {
          for (int x = std::max(c - 1, 0); x <= std::min(c + 1, grid.cols - 1); ++x) {
            if (before[grid.Index(y, x)] == 0) continue;
            sum += grid.At(y, x);
            ++count;
          }
        }
        if (count == 0) continue;
        grid.At(r, c) = sum / count;
        is_filled[grid.Index(r, c)] = 1;
        has_changed = true;
      }
    }
  }
}

// Binomial 3 × 3 blur: against the noise and the bands of sampling.
void Smooth(LightGrid& grid) {
  const LightGrid before = grid;
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.cols; ++c) {
      Vector3f sum(0, 0, 0);
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const float weight = static_cast<float>((2 - std::abs(dx)) * (2 - std::abs(dy))) / 16.0f;
          sum += weight * before.At(std::clamp(r + dy, 0, grid.rows - 1),
                                    std::clamp(c + dx, 0, grid.cols - 1));
        }
      }
      grid.At(r, c) = sum;
    }
  }
}

// Which cells of a grid light can reach. Where everything is covered closely, as in the gap behind
// a door's hinges, the gaps count as open.
std::vector<char> FindOpenCells(const std::vector<Surface>& surfaces, const RayScene& scene,
                                const Surface& surface, const LightGrid& grid) {
  std::vector<char> is_open(grid.irradiance.size(), 0);
  for (const float cover_m : {kCoveredWithin_m, 0.0f}) {
    bool is_any_open = false;
    for (int r = 0; r < grid.rows; ++r) {
      for (int c = 0; c < grid.cols; ++c) {
        if (!IsOpen(surfaces, scene, surface, grid.Center(r, c), cover_m)) continue;
        is_open[grid.Index(r, c)] = 1;
        is_any_open = true;
      }
    }
    if (is_any_open) break;
  }
  return is_open;
}

// Sets every open cell of a grid to `irradiance(point)` and the others to their neighbours' mean.
template <typename F>
void FillGrid(const Surface& surface, std::vector<char> is_open, const F& irradiance,
              LightGrid& grid) {
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.cols; ++c) {
      if (is_open[grid.Index(r, c)] == 0) continue;
      const Vector2f uv = grid.Center(r, c);
      grid.At(r, c) = irradiance(surface.Point(uv.x(), uv.y()) + kLift_m * surface.normal);
    }
  }
  FillClosedCells(grid, is_open);
}

}  // namespace

LightGrid MakeLightGrid(const Vector2f& extent, float max_cell_m) {
  LightGrid grid;
  grid.cols = std::max(1, static_cast<int>(std::ceil(extent.x() / max_cell_m)));
  grid.rows = std::max(1, static_cast<int>(std::ceil(extent.y() / max_cell_m)));
  grid.cell = {extent.x() / static_cast<float>(grid.cols),
               extent.y() / static_cast<float>(grid.rows)};
  grid.irradiance.assign(static_cast<size_t>(grid.cols) * static_cast<size_t>(grid.rows),
                         Vector3f(0, 0, 0));
  return grid;
}

Vector3f SunIrradiance(const Home& home, const RayScene& scene, const Vector3f& point,
                       const Vector3f& normal) {
  constexpr float kOutside_m = 200;
  if (!home.sun) return Vector3f::Zero();
  const Vector3f direction = home.sun->direction.cast<float>();
  const float cosine = normal.dot(direction);
  const Vector3f lifted = point + kLift_m * normal;
  if (cosine <= 0 || scene.IsBlocked(lifted, lifted + kOutside_m * direction))
    return Vector3f::Zero();
  return cosine * home.sun->irradiance;
}

BakedLight BakeLight(const Home& home, const std::vector<Surface>& surfaces, const RayScene& scene,
                     const RenderOptions& options, RunContext& context) {
  const std::vector<AreaLight> lights = CollectLights(home);
  const auto num_surfaces = static_cast<int64_t>(surfaces.size());
  const auto cell_m = static_cast<float>(options.light_cell_m);
  BakedLight light;
  for (const Surface& surface : surfaces) {
    light.direct.push_back(MakeLightGrid(surface.extent, cell_m));
    light.reflected.push_back(MakeLightGrid(surface.extent, kReflectedCells * cell_m));
  }
  ParallelFor(context, "direct light", num_surfaces, [&](int64_t i) {
    const auto idx = static_cast<size_t>(i);
    const Surface& surface = surfaces[idx];
    LightGrid& grid = light.direct[idx];
    const std::vector<AreaLight> near = LightsFor(home, lights, surface.room_id);
    const auto irradiance = [&](const Vector3f& point) {
      return DirectIrradiance(near, scene, point, surface.normal);
    };
    FillGrid(surface, FindOpenCells(surfaces, scene, surface, grid), irradiance, grid);
    Smooth(grid);
  });
  for (int bounce = 0; bounce < options.bounces; ++bounce) {
    std::vector<LightGrid> next = light.reflected;
    ParallelFor(context, "reflected light", num_surfaces, [&](int64_t i) {
      const auto idx = static_cast<size_t>(i);
      const Surface& surface = surfaces[idx];
      Random random(PartSeed(home.seed, static_cast<uint64_t>(i)));
      const auto irradiance = [&](const Vector3f& point) {
        return GatheredIrradiance(home, surfaces, scene, light, surface, point, options.gather_rays,
                                  random);
      };
      FillGrid(surface, FindOpenCells(surfaces, scene, surface, next[idx]), irradiance, next[idx]);
      for (int k = 0; k < kSmoothings; ++k) Smooth(next[idx]);
    });
    light.reflected = std::move(next);
  }
  return light;
}

}  // namespace enfilade
