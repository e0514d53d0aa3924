// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/synthetic/fixture_points.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"
#include "src/synthetic/finish.h"
#include "src/synthetic/random.h"
#include "src/synthetic/ray_scene.h"

namespace enfilade {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr float kLift_m = 1e-3f;        // rays end off the surface
constexpr float kMinCosine = 0.15f;     // flatter looks tell nothing
constexpr float kWindow_rad = 0.0175f;  // half the window in which contrast is sought
constexpr double kNearest_m = 0.3;      // of points along their ray

// What rays see of a home.
struct VisibleHome {
  std::vector<Surface> surfaces;
  RayScene scene;
  std::vector<Vector3f> cameras;

  explicit VisibleHome(const Home& home) : surfaces(MakeSurfaces(home)), scene(surfaces) {
    for (const HomeCamera& camera : home.cameras)
      cameras.push_back(camera.home_from_cam.translation.cast<float>());
  }
};

// Where stereo could find a point: on a surface, or its image behind a mirror.
struct Place {
  Vector3f position, normal;  // of the image, for mirrors
  Vector3f reflectance;
  int mirror_idx = -1;         // surface in which it shows
  Vector3f mirrored{0, 0, 0};  // the thing itself, off its surface
};

Vector3f ReflectedAt(const Surface& mirror, const Vector3f& direction) {
  return direction - 2 * mirror.normal.dot(direction) * mirror.normal;
}

// The first surface along the ray, or what it shows where it is a mirror.
std::optional<RayHit> TraceThroughMirror(const VisibleHome& home, const Vector3f& origin,
                                         const Vector3f& direction) {
  const std::optional<RayHit> hit = home.scene.Trace(origin, direction);
  if (!hit) return hit;
  const Surface& surface = home.surfaces[static_cast<size_t>(hit->surface_idx)];
  if (surface.finish != Finish::kMirror) return hit;
  return home.scene.Trace(surface.Point(hit->u, hit->v) + kLift_m * surface.normal,
                          ReflectedAt(surface, direction));
}

bool Sees(const VisibleHome& home, const Vector3f& camera, const Place& place, double max_range_m) {
  const Vector3f offset = place.position - camera;
  const float distance_m = offset.norm();
  if (distance_m > max_range_m || -place.normal.dot(offset) < kMinCosine * distance_m) return false;
  if (place.mirror_idx < 0)
    return !home.scene.IsBlocked(camera, place.position + kLift_m * place.normal);
  const std::optional<RayHit> hit = home.scene.Trace(camera, offset / distance_m);
  if (!hit || hit->surface_idx != place.mirror_idx) return false;
  const Surface& mirror = home.surfaces[static_cast<size_t>(place.mirror_idx)];
  return !home.scene.IsBlocked(mirror.Point(hit->u, hit->v) + kLift_m * mirror.normal,
                               place.mirrored);
}

// The image of what the nearest camera sees in the mirror at `point`; none where that is the sky or
// another mirror.
std::optional<Place> PlaceInMirror(const VisibleHome& home, int mirror_idx, const Vector3f& point) {
  const Surface& mirror = home.surfaces[static_cast<size_t>(mirror_idx)];
  const auto distance = [&](const Vector3f& camera) { return (camera - point).squaredNorm(); };
  const Vector3f camera = *std::min_element(
      home.cameras.begin(), home.cameras.end(),
      [&](const Vector3f& a, const Vector3f& b) { return distance(a) < distance(b); });
  const Vector3f direction = (point - camera).normalized();
  if (mirror.normal.dot(direction) >= 0) return std::nullopt;
  const std::optional<RayHit> hit =
      home.scene.Trace(point + kLift_m * mirror.normal, ReflectedAt(mirror, direction));
  if (!hit) return std::nullopt;
  const Surface& surface = home.surfaces[static_cast<size_t>(hit->surface_idx)];
  if (surface.finish == Finish::kMirror) return std::nullopt;
  Place place;
  place.mirror_idx = mirror_idx;
  place.mirrored = surface.Point(hit->u, hit->v) + kLift_m * surface.normal;
  place.position = point + hit->distance_m * direction;
  place.normal = ReflectedAt(mirror, surface.normal);
  place.reflectance = ReflectanceAt(surface, hit->u, hit->v);
  return place;
}

// Two unit vectors at right angles to a unit one and to each other.
std::pair<Vector3f, Vector3f> AxesAcross(const Vector3f& direction) {
  const Vector3f right = direction.unitOrthogonal();
  return {right, direction.cross(right)};
}

// Standard deviation over mean of the reflectance in a window round the place as a camera sees it.
double ContrastAt(const VisibleHome& home, const Vector3f& camera, const Place& place) {
  const Vector3f direction = (place.position - camera).normalized();
  const auto [right, down] = AxesAcross(direction);
  double sum = 0, squares = 0;
  for (const float y : {-kWindow_rad, 0.0f, kWindow_rad}) {
    for (const float x : {-kWindow_rad, 0.0f, kWindow_rad}) {
      const Vector3f ray = (direction + x * right + y * down).normalized();
      const std::optional<RayHit> hit = TraceThroughMirror(home, camera, ray);
      const double grey =
          hit ? ReflectanceAt(home.surfaces[static_cast<size_t>(hit->surface_idx)], hit->u, hit->v)
                    .mean()
              : SkyRadiance(ray).mean();
      sum += grey / 9;
      squares += grey * grey / 9;
    }
  }
  return sum > 0 ? std::sqrt(std::max(0.0, squares - sum * sum)) / sum : 0;
}

double LargestAngle(const std::vector<Vector3f>& cameras, const std::vector<int>& views,
                    const Vector3f& position) {
  float least_cosine = 1;
  for (const int a : views) {
    for (const int b : views) {
      const Vector3f to_a = cameras[static_cast<size_t>(a)] - position,
                     to_b = cameras[static_cast<size_t>(b)] - position;
      least_cosine = std::min(least_cosine, to_a.normalized().dot(to_b.normalized()));
    }
  }
  return std::acos(std::clamp(least_cosine, -1.0f, 1.0f));
}

// A place that cameras recognised.
struct Match {
  Place place;
  std::vector<int> views;
  int nearest = 0;        // of the views
  double baseline_m = 0;  // largest across the nearest view's ray
};

std::optional<Match> MatchPlace(const VisibleHome& home, const Place& place,
                                const PointNoise& noise, Random& random) {
  Match match{place, {}, 0, 0};
  float nearest_m = 0;
  for (size_t i = 0; i < home.cameras.size(); ++i) {
    if (!Sees(home, home.cameras[i], place, noise.max_range_m)) continue;
    if (!random.Chance(noise.match_probability)) continue;
    const float distance_m = (home.cameras[i] - place.position).norm();
    if (match.views.empty() || distance_m < nearest_m) {
      match.nearest = static_cast<int>(i);
      nearest_m = distance_m;
    }
    match.views.push_back(static_cast<int>(i));
  }
  if (static_cast<int>(match.views.size()) < noise.min_views) return std::nullopt;
  if (LargestAngle(home.cameras, match.views, place.position) < DegToRad(noise.min_angle_deg))
    return std::nullopt;
  const Vector3f& camera = home.cameras[static_cast<size_t>(match.nearest)];
  const double contrast = ContrastAt(home, camera, place);
  const double half = noise.half_contrast;
  if (half > 0 && !random.Chance(contrast * contrast / (contrast * contrast + half * half)))
    return std::nullopt;
  const Vector3f ray = (place.position - camera).normalized();
  for (const int i : match.views) {
    const Vector3f& other = home.cameras[static_cast<size_t>(i)];
    match.baseline_m = std::max<double>(match.baseline_m, (other - camera).cross(ray).norm());
  }
  return match;
}

// Where triangulation puts a match, in the home frame.
Vector3d NoisyPosition(const VisibleHome& home, const Match& match, const PointNoise& noise,
                       Random& random) {
  const Vector3f& camera = home.cameras[static_cast<size_t>(match.nearest)];
  const Vector3f offset = match.place.position - camera;
  const double d = offset.norm(), across_m = DegToRad(noise.ray_sigma_deg) * d;
  const Vector3f direction = offset.normalized();
  if (random.Chance(noise.outlier_share))
    return (camera + static_cast<float>(random.Uniform(kNearest_m, 2 * d)) * direction)
        .cast<double>();
  const auto [right, down] = AxesAcross(direction);
  const double along_m = DegToRad(noise.match_sigma_deg) * d * d / match.baseline_m;
  const double along = std::clamp(along_m * random.Normal(), -0.5 * d, 0.5 * d);
  const double x = across_m * random.Normal(), y = across_m * random.Normal();
  return match.place.position.cast<double>() + along * direction.cast<double>() +
         x * right.cast<double>() + y * down.cast<double>();
}

Vector3d NoisyNormal(const VisibleHome& home, const Match& match, double sigma_rad,
                     Random& random) {
  const auto [right, down] = AxesAcross(match.place.normal);
  const double x = std::tan(sigma_rad * random.Normal()), y = std::tan(sigma_rad * random.Normal());
  const Vector3d normal =
      (match.place.normal.cast<double>() + x * right.cast<double>() + y * down.cast<double>())
          .normalized();
  const Vector3f& camera = home.cameras[static_cast<size_t>(match.nearest)];
  return normal.dot((camera - match.place.position).cast<double>()) < 0 ? -normal : normal;
}

ScenePoint MakePoint(const VisibleHome& home, const Match& match, const PointNoise& noise,
                     Random& random) {
  ScenePoint point;
  point.position = NoisyPosition(home, match, noise, random);
  point.normal = NoisyNormal(home, match, DegToRad(noise.normal_sigma_deg), random);
  for (int k = 0; k < 3; ++k) {
    const float reflectance = std::clamp(match.place.reflectance[k], 0.0f, 1.0f);
    point.rgb[k] = static_cast<uint8_t>(std::lround(255 * std::pow(reflectance, 1 / 2.2f)));
  }
  point.view_idx = match.views;
  return point;
}

// Round holes in a surface. Their centres also lie beyond its border, so that holes are as frequent
// there: the share that a Poisson process of discs covers is 1 − exp(−density · area of a disc).
class Holes {
 public:
  Holes(const Surface& surface, const PointNoise& noise, Random random) {
    const auto radius = static_cast<float>(noise.hole_radius_m);
    if (noise.hole_share <= 0) return;
    const double num_per_m2 =
        -std::log1p(-noise.hole_share) / (kPi * noise.hole_radius_m * noise.hole_radius_m);
    const Vector2f size = surface.extent + Vector2f::Constant(2 * radius);
    // Poisson (Knuth 1969): arrivals of an exponential clock.
    for (double time = -std::log1p(-random.Uniform()); time < num_per_m2 * size.prod();
         time -= std::log1p(-random.Uniform())) {
      const auto u = static_cast<float>(random.Uniform()), v = static_cast<float>(random.Uniform());
      centers_.push_back(Vector2f(u, v).cwiseProduct(size) - Vector2f::Constant(radius));
    }
    squared_ = radius * radius;
  }

  [[nodiscard]] bool Contain(const Vector2f& uv) const {
    return std::any_of(centers_.begin(), centers_.end(),
                       [&](const Vector2f& c) { return (uv - c).squaredNorm() < squared_; });
  }

 private:
  std::vector<Vector2f> centers_;
  float squared_ = 0;
};

// Calls visit(uv) for points drawn evenly over a surface, one for every spacing_m² on average.
template <typename F>
void ForPlacesOn(const Surface& surface, double spacing_m, Random& random, const F& visit) {
  for (const std::array<int, 3>& triangle : surface.triangles) {
    const Vector2f& a = surface.vertices[static_cast<size_t>(triangle[0])];
    const Vector2f ab = surface.vertices[static_cast<size_t>(triangle[1])] - a,
                   ac = surface.vertices[static_cast<size_t>(triangle[2])] - a;
    const double area = 0.5 * std::abs(ab.x() * ac.y() - ab.y() * ac.x());
    const auto count = static_cast<int64_t>(area / (spacing_m * spacing_m) + random.Uniform());
    for (int64_t k = 0; k < count; ++k) {
      auto s = static_cast<float>(random.Uniform()), t = static_cast<float>(random.Uniform());
      if (s + t > 1) {
        s = 1 - s;
        t = 1 - t;
      }
      visit(Vector2f(a + s * ab + t * ac));
    }
  }
}

std::vector<ScenePoint> PointsOnSurface(const VisibleHome& home, int surface_idx,
                                        const PointNoise& noise) {
  const Surface& surface = home.surfaces[static_cast<size_t>(surface_idx)];
  const uint64_t seed = PartSeed(noise.seed, static_cast<uint64_t>(surface_idx));
  const Holes holes(surface, noise, Random(PartSeed(seed, 0)));
  Random places(PartSeed(seed, 1));
  uint64_t num_places = 0;
  std::vector<ScenePoint> points;
  ForPlacesOn(surface, noise.spacing_m, places, [&](const Vector2f& uv) {
    Random random(PartSeed(PartSeed(seed, 2), num_places++));  // other places change nothing here
    if (holes.Contain(uv)) return;
    const Vector3f position = surface.Point(uv.x(), uv.y());
    std::optional<Place> place;
    if (surface.finish == Finish::kMirror) {
      place = PlaceInMirror(home, surface_idx, position);
    } else {
      place = Place{position, surface.normal, ReflectanceAt(surface, uv.x(), uv.y())};
    }
    if (!place) return;
    const std::optional<Match> match = MatchPlace(home, *place, noise, random);
    if (match) points.push_back(MakePoint(home, *match, noise, random));
  });
  return points;
}

// Moves a share of the points into clumps that float before the surfaces of others.
void MakeClumps(const VisibleHome& home, const PointNoise& noise, std::vector<ScenePoint>& points) {
  Random random(PartSeed(noise.seed, home.surfaces.size()));
  std::vector<size_t> moved;
  for (size_t i = 0; i < points.size(); ++i) {
    if (random.Chance(noise.clump_share)) moved.push_back(i);
  }
  const std::vector<ScenePoint> before = points;
  const ScenePoint* seen = nullptr;
  Vector3d center(0, 0, 0);
  for (size_t k = 0; k < moved.size(); ++k) {
    if (k % static_cast<size_t>(noise.points_per_clump) == 0) {
      seen = &random.Pick(before);
      const Vector3d camera = home.cameras[static_cast<size_t>(seen->view_idx[0])].cast<double>();
      center = camera + random.Uniform() * (seen->position - camera);
    }
    ScenePoint& point = points[moved[k]];
    point = *seen;
    const double x = random.Normal(), y = random.Normal(), z = random.Normal();
    point.position = center + noise.clump_radius_m * Vector3d(x, y, z);
  }
}

}  // namespace

std::vector<ScenePoint> FixturePoints(const Home& home, const PointNoise& noise) {
  ENFILADE_CHECK(noise.spacing_m > 0 && noise.points_per_clump > 0);
  ENFILADE_CHECK(noise.min_views >= 2 && noise.min_angle_deg > 0);
  ENFILADE_CHECK(noise.hole_share >= 0 && noise.hole_share < 1 && noise.hole_radius_m > 0);
  const VisibleHome visible(home);
  std::vector<ScenePoint> points;
  if (visible.cameras.empty()) return points;
  for (size_t i = 0; i < visible.surfaces.size(); ++i) {
    const std::vector<ScenePoint> more = PointsOnSurface(visible, static_cast<int>(i), noise);
    points.insert(points.end(), more.begin(), more.end());
  }
  MakeClumps(visible, noise, points);
  const Rigid3 world_from_home = home.home_from_world.Inverse();
  for (ScenePoint& point : points) {
    point.position = world_from_home * point.position;
    point.normal = world_from_home.rotation * point.normal;
  }
  return points;
}

}  // namespace enfilade
