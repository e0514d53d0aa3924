// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/synthetic/render.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/scene/camera.h"
#include "src/synthetic/finish.h"
#include "src/synthetic/lamp.h"
#include "src/synthetic/light.h"
#include "src/synthetic/random.h"
#include "src/synthetic/ray_scene.h"
#include "src/synthetic/sensor.h"

namespace enfilade {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// The glass of a window: a level edge, the height above it, and the unit normal towards its room.
/// Light goes through it as if it were not there, but one sees the room in it.
struct GlassPane {
  Vector3f origin, along, normal;
  float height = 0;
};

/// A storey of a home ready to be looked at.
struct LitStorey {
  Home home;
  RenderOptions options;
  std::vector<Surface> surfaces;
  std::vector<GlassPane> panes;
  std::unique_ptr<RayScene> scene;
  std::vector<LampShade> shades;
  BakedLight light;
  std::map<int, float> exposure_of_room;
};

namespace {

constexpr double kWallTone = 0.82;
constexpr float kMirrorReflectance = 0.9f;
constexpr float kPi_f = static_cast<float>(kPi);
constexpr double kPaneDepth = 0.6;   // share of the wall's thickness
constexpr float kShadeGlow = 0.10f;  // lamps are this share of their radiance: what the shade shows

// Light from what a ray met, mirror images left out. There is no `hit` any more where a lamp stands
// before it.
Vector3f DiffuseRadiance(const LitStorey& lit, const Vector3f& origin, const Vector3f& direction,
                         std::optional<RayHit>& hit) {
  const float hit_m = hit ? hit->distance_m : std::numeric_limits<float>::infinity();
  const std::optional<LampHit> shade = TraceLamps(lit.shades, origin, direction, hit_m);
  if (shade) {
    hit.reset();
    return kShadeGlow * shade->lamp->radiance;
  }
  if (!hit) return SkyRadiance(direction);
  const Surface& surface = lit.surfaces[static_cast<size_t>(hit->surface_idx)];
  const Vector3f point = origin + hit->distance_m * direction;
  const Vector3f irradiance =
      lit.light.IrradianceAt(*hit) + SunIrradiance(lit.home, *lit.scene, point, surface.normal);
  return ReflectanceAt(surface, hit->u, hit->v).cwiseProduct(irradiance) / kPi_f;
}

Vector3f MirroredRadiance(const LitStorey& lit, const Vector3f& origin, const Vector3f& direction) {
  std::optional<RayHit> hit = lit.scene->Trace(origin, direction);
  return DiffuseRadiance(lit, origin, direction, hit);
}

float Fresnel(float cosine) {
  return 0.04f + 0.96f * std::pow(1 - std::clamp(cosine, 0.0f, 1.0f), 5.0f);  // Schlick 1994
}

std::vector<GlassPane> CollectPanes(const Home& home, int storey_idx) {
  std::vector<GlassPane> panes;
  for (const HomeOpening& opening : home.openings) {
    if (opening.kind != OpeningKind::kWindow) continue;
    if (!home.IsOnStorey(opening.room_id, storey_idx)) continue;
    const Eigen::Vector2d into = opening.IntoWall(), along = opening.b - opening.a;
    const Eigen::Vector2d corner = opening.a + kPaneDepth * opening.thickness_m * into;
    GlassPane pane;
    pane.origin = Vector3d(corner.x(), corner.y(), opening.sill_z).cast<float>();
    pane.along = Vector3d(along.x(), along.y(), 0).cast<float>();
    pane.normal = Vector3d(-into.x(), -into.y(), 0).cast<float>();
    pane.height = static_cast<float>(opening.head_z - opening.sill_z);
    panes.push_back(pane);
  }
  return panes;
}

// Distance to the nearest pane along the ray, none beyond `far_m`.
const GlassPane* PaneBefore(const std::vector<GlassPane>& panes, const Vector3f& origin,
                            const Vector3f& direction, float far_m, float& distance_m) {
  const GlassPane* nearest = nullptr;
  for (const GlassPane& pane : panes) {
    const float at_m = pane.normal.dot(pane.origin - origin) / pane.normal.dot(direction);
    if (!(at_m > 0 && at_m < far_m)) continue;
    const Vector3f offset = origin + at_m * direction - pane.origin;
    const float u = offset.dot(pane.along) / pane.along.squaredNorm();
    if (u < 0 || u > 1 || offset.z() < 0 || offset.z() > pane.height) continue;
    far_m = distance_m = at_m;
    nearest = &pane;
  }
  return nearest;
}

// Light from what a ray met, without panes before it.
Vector3f OpaqueRadiance(const LitStorey& lit, const Vector3f& origin, const Vector3f& direction,
                        std::optional<RayHit>& hit) {
  const Vector3f diffuse = DiffuseRadiance(lit, origin, direction, hit);
  if (!hit) return diffuse;
  const Surface& surface = lit.surfaces[static_cast<size_t>(hit->surface_idx)];
  const bool is_mirror = surface.finish == Finish::kMirror;
  if (surface.gloss <= 0 && !is_mirror) return diffuse;
  const float cosine = std::clamp(-surface.normal.dot(direction), 0.0f, 1.0f);
  const Vector3f mirrored = direction + 2 * cosine * surface.normal;
  const Vector3f start = origin + hit->distance_m * direction + 1e-3f * surface.normal;
  const Vector3f image = MirroredRadiance(lit, start, mirrored.normalized());
  const float weight = is_mirror ? kMirrorReflectance : surface.gloss * Fresnel(cosine);
  return (1 - weight) * diffuse + weight * image;
}

Vector3f RadianceAlong(const LitStorey& lit, const Vector3f& origin, const Vector3f& direction,
                       std::optional<RayHit> hit) {
  const Vector3f behind = OpaqueRadiance(lit, origin, direction, hit);
  const float far_m = hit ? hit->distance_m : std::numeric_limits<float>::infinity();
  float pane_m = 0;
  const GlassPane* pane = PaneBefore(lit.panes, origin, direction, far_m, pane_m);
  if (pane == nullptr) return behind;
  const float cosine = pane->normal.dot(direction);
  const Vector3f mirrored = direction - 2 * cosine * pane->normal;
  const Vector3f start = origin + pane_m * direction;
  const float weight = Fresnel(std::abs(cosine));
  return (1 - weight) * behind + weight * MirroredRadiance(lit, start, mirrored);
}

struct WallLight {
  double sum = 0, area = 0;
  [[nodiscard]] double Mean() const { return area > 0 && sum > 0 ? sum / area : 1; }
};

// Mean radiance of the painted walls, by room.
std::map<int, WallLight> MeasureWalls(const std::vector<Surface>& surfaces,
                                      const BakedLight& light) {
  std::map<int, WallLight> walls;
  for (size_t i = 0; i < surfaces.size(); ++i) {
    const bool is_painted =
        surfaces[i].finish == Finish::kPaint || surfaces[i].finish == Finish::kOrangePeel;
    if (surfaces[i].wall_id < 0 || !is_painted) continue;
    const LightGrid& grid = light.reflected[i];
    WallLight& wall = walls[surfaces[i].room_id];
    for (int r = 0; r < grid.rows; ++r) {
      for (int c = 0; c < grid.cols; ++c) {
        const Eigen::Vector2f uv = grid.Center(r, c);
        const RayHit hit{static_cast<int>(i), 0, uv.x(), uv.y()};
        wall.sum +=
            grid.cell.prod() * surfaces[i].rgb.cwiseProduct(light.IrradianceAt(hit)).mean() / kPi;
        wall.area += grid.cell.prod();
      }
    }
  }
  return walls;
}

// Walls become a fixed tone: two thirds after the room's own light and one third after the home's,
// as cameras that keep their exposures alike do.
std::map<int, float> ChooseExposures(const std::vector<Surface>& surfaces,
                                     const BakedLight& light) {
  const std::map<int, WallLight> walls = MeasureWalls(surfaces, light);
  WallLight all;
  for (const auto& [room_id, wall] : walls) {
    all.sum += wall.sum;
    all.area += wall.area;
  }
  std::map<int, float> exposures;
  for (const auto& [room_id, wall] : walls) {
    exposures[room_id] = static_cast<float>(kWallTone * std::pow(wall.Mean(), -2.0 / 3) *
                                            std::pow(all.Mean(), -1.0 / 3));
  }
  return exposures;
}

// The sRGB curve in 255ths over [0, 1], tabulated: three powers a sample would be a tenth of a
// picture's time. Between the entries it is straight, off by less than 0.01.
class SrgbCurve {
 public:
  SrgbCurve() {
    for (size_t i = 0; i < values_.size(); ++i) {
      const double linear = std::min(1.0, static_cast<double>(i) / kSteps);
      values_[i] = static_cast<float>(
          255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055));
    }
  }

  [[nodiscard]] float operator()(float linear) const {
    const float place = std::min<float>(kSteps, kSteps * linear);  // of no number too
    const auto i = static_cast<size_t>(place);
    return values_[i] + (place - static_cast<float>(i)) * (values_[i + 1] - values_[i]);
  }

 private:
  static constexpr int kSteps = 4096;
  std::array<float, kSteps + 2> values_{};
};

// Compresses the highlights (Reinhard et al. 2002, eq. 4), then the sRGB curve; in [0, 255].
Vector3f ToneMap(const Vector3f& radiance) {
  static const SrgbCurve srgb;
  constexpr float kWhite = 3.0f;
  const Eigen::Array3f x = radiance.array().max(0.0f);
  const Eigen::Array3f linear = (x * (1 + x / (kWhite * kWhite)) / (1 + x) * 1.12f).min(1.0f);
  return {srgb(linear[0]), srgb(linear[1]), srgb(linear[2])};
}

// Height of the stand's silhouette above the nadir in each column, as a share of the rows: a disc
// with three legs.
std::vector<double> StandShares(double stand_share, int num_columns, double turn) {
  std::vector<double> shares;
  for (int col = 0; col < num_columns; ++col) {
    const double leg = std::cos(3 * 2 * kPi * ((col + 0.5) / num_columns + turn));
    shares.push_back(stand_share * (1 + 0.35 * std::pow(std::max(0.0, leg), 24)));
  }
  return shares;
}

// Places in a pixel: the R2 sequence (Roberts 2018), moved so that its mean is the pixel's centre.
std::vector<Eigen::Vector2d> SampleOffsets(int num_samples) {
  std::vector<Eigen::Vector2d> offsets;
  Eigen::Vector2d mean(0, 0);
  for (int s = 1; s <= num_samples; ++s) {
    offsets.emplace_back(std::fmod(0.7548776662 * s, 1.0), std::fmod(0.5698402910 * s, 1.0));
    mean += offsets.back() / num_samples;
  }
  for (Eigen::Vector2d& offset : offsets) offset += Eigen::Vector2d(0.5, 0.5) - mean;
  return offsets;
}

// The rays through a picture's pixels: some samples a pixel, then its centre. A panorama's ray is
// the product of what its row and its column say, so there are sines for each of these only.
class PixelRays {
 public:
  PixelRays(const Camera& camera, const Eigen::Matrix3d& home_from_cam,
            std::vector<Eigen::Vector2d> offsets)
      : camera_(camera), home_from_cam_(home_from_cam), offsets_(std::move(offsets)) {
    if (camera_.model == CameraModel::kPinhole) return;
    for (int col = 0; col < camera_.width; ++col) {
      for (const Eigen::Vector2d& offset : offsets_) {
        level_.push_back(home_from_cam *
                         camera_.RayFromPixel({col + offset.x(), 0.5 * camera_.height}));
      }
    }
  }

  [[nodiscard]] size_t num_per_pixel() const { return offsets_.size(); }

  /// Unit directions in the home frame through a row's pixels, from left to right.
  [[nodiscard]] std::vector<Vector3f> Row(int row) const {
    return camera_.model == CameraModel::kPinhole ? PinholeRow(row) : PanoramaRow(row);
  }

 private:
  [[nodiscard]] std::vector<Vector3f> PinholeRow(int row) const {
    std::vector<Vector3f> directions;
    for (int col = 0; col < camera_.width; ++col) {
      for (const Eigen::Vector2d& offset : offsets_) {
        const Vector3d ray = camera_.RayFromPixel({col + offset.x(), row + offset.y()});
        directions.push_back((home_from_cam_ * ray).cast<float>());
      }
    }
    return directions;
  }

  [[nodiscard]] std::vector<Vector3f> PanoramaRow(int row) const {
    const Vector3d down = home_from_cam_.col(1);
    std::vector<Vector3d> upright;  // in the plane of `down` and the level ray
    for (const Eigen::Vector2d& offset : offsets_)
      upright.push_back(camera_.RayFromPixel({0.5 * camera_.width, row + offset.y()}));
    std::vector<Vector3f> directions(level_.size());
    for (size_t i = 0; i < level_.size(); i += upright.size()) {
      for (size_t s = 0; s < upright.size(); ++s) {
        directions[i + s] = (upright[s].z() * level_[i + s] + upright[s].y() * down).cast<float>();
      }
    }
    return directions;
  }

  Camera camera_;
  Eigen::Matrix3d home_from_cam_;
  std::vector<Eigen::Vector2d> offsets_;  // in a pixel
  std::vector<Vector3d> level_;           // rays at the horizon; panoramas only
};

struct PixelJob {
  const LitStorey& lit;
  ImageSize size;
  Vector3f origin;
  Eigen::Matrix3d world_from_home;
  double stand_share;                // of the rows
  std::vector<double> stand_shares;  // one a column
  float exposure;
  PixelRays rays;
};

// A pixel's rays and what they hit.
struct Looks {
  std::span<const Vector3f> directions;
  std::span<const std::optional<RayHit>> hits;
};

void RenderColour(const PixelJob& job, const Looks& looks, float* rgb) {
  const size_t num_samples = looks.hits.size() - 1;
  Vector3f sum(0, 0, 0);
  for (size_t s = 0; s < num_samples; ++s) {
    sum += ToneMap(job.exposure *
                   RadianceAlong(job.lit, job.origin, looks.directions[s], looks.hits[s]));
  }
  for (int k = 0; k < 3; ++k) rgb[k] = sum[k] / static_cast<float>(num_samples);
}

void RenderTruth(const PixelJob& job, const Vector3f& direction, const std::optional<RayHit>& hit,
                 int row, int col, RenderedPanorama& out) {
  const float hit_m = hit ? hit->distance_m : std::numeric_limits<float>::infinity();
  const std::optional<LampHit> shade = TraceLamps(job.lit.shades, job.origin, direction, hit_m);
  Vector3d normal_in_home(0, 0, -1);
  if (shade) {
    out.range_m(row, col) = shade->distance_m;
    out.room_id(row, col) = static_cast<int16_t>(shade->lamp->room_id);
  } else if (hit) {
    const Surface& surface = job.lit.surfaces[static_cast<size_t>(hit->surface_idx)];
    out.range_m(row, col) = hit->distance_m;
    out.label(row, col) = static_cast<uint8_t>(surface.label);
    out.room_id(row, col) = static_cast<int16_t>(surface.room_id);
    out.wall_id(row, col) = static_cast<int16_t>(surface.wall_id);
    normal_in_home = surface.normal.cast<double>();
  } else {
    return;
  }
  const Vector3d normal = job.world_from_home * normal_in_home;
  for (int k = 0; k < 3; ++k) out.normal(row, col, k) = static_cast<float>(normal[k]);
}

// Lighter at the rim, darker towards the nadir.
float StandGrey(const PixelJob& job, int row) {
  const double depth = 1 - (row + 0.5) / job.size.height;
  const double share = depth / std::max(job.stand_share, 1e-6);
  return static_cast<float>(18 + 26 * std::clamp(share, 0.0, 1.0));
}

void RenderRow(const PixelJob& job, int row, ImageF& ideal, RenderedPanorama& out) {
  const double height_share = 1 - (row + 0.5) / job.size.height;
  const bool is_all_stand = height_share < job.stand_share;
  const size_t n = job.rays.num_per_pixel();
  std::vector<Vector3f> directions;
  std::vector<std::optional<RayHit>> hits;
  if (!is_all_stand) {
    directions = job.rays.Row(row);
    hits.resize(directions.size());
    job.lit.scene->TraceFrom(job.origin, directions, hits);
  }
  for (int col = 0; col < job.size.width; ++col) {
    if ((row + 0.5) / job.size.height > 1 - job.stand_shares[static_cast<size_t>(col)]) {
      std::fill_n(&ideal(row, col), 3, StandGrey(job, row));
      continue;
    }
    const size_t first = n * static_cast<size_t>(col);
    const Looks looks{std::span(directions).subspan(first, n), std::span(hits).subspan(first, n)};
    RenderColour(job, looks, &ideal(row, col));
    RenderTruth(job, looks.directions.back(), looks.hits.back(), row, col, out);
  }
}

RenderedPanorama BlankPanorama(ImageSize size) {
  RenderedPanorama out;
  out.range_m = ImageF(size.height, size.width);
  out.normal = ImageF(size.height, size.width, 3);
  out.label = ImageU8(size.height, size.width);
  out.room_id = Image<int16_t>(size.height, size.width, 1, -1);
  out.wall_id = Image<int16_t>(size.height, size.width, 1, -1);
  return out;
}

// What is on other storeys is left out: out of a window one would see it from behind.
std::unique_ptr<const LitStorey> LightStorey(const Home& home, int storey_idx,
                                             const RenderOptions& options, RunContext& context) {
  auto lit = std::make_unique<LitStorey>();
  lit->home = home;
  lit->options = options;
  lit->surfaces = MakeSurfaces(home, storey_idx);
  lit->panes = CollectPanes(home, storey_idx);
  lit->scene = std::make_unique<RayScene>(lit->surfaces);
  lit->shades = MakeLampShades(lit->home, storey_idx);
  lit->light = BakeLight(home, lit->surfaces, *lit->scene, lit->options, context);
  lit->exposure_of_room = ChooseExposures(lit->surfaces, lit->light);
  return lit;
}

}  // namespace

HomeRenderer::HomeRenderer(const Home& home, const RenderOptions& options, RunContext& context) {
  RenderOptions checked = options;
  ValidateOptions(VisitorOf(checked), "synthetic rendering");
  for (int i = 0; i < home.NumStoreys(); ++i)
    storeys_.push_back(LightStorey(home, i, checked, context));
}

HomeRenderer::~HomeRenderer() = default;

const Home& HomeRenderer::home() const {
  ENFILADE_CHECK(!storeys_.empty());
  return storeys_[0]->home;
}

RenderedPanorama HomeRenderer::Render(int camera_idx, ImageSize size, RunContext& context) const {
  ENFILADE_CHECK(size.height > 0 && size.width == 2 * size.height);
  const uint64_t seed = PartSeed(home().seed + 2, static_cast<uint64_t>(camera_idx));
  return RenderPicture(camera_idx, EquirectangularCamera(size.width, size.height),
                       Eigen::Matrix3d::Identity(), seed, context);
}

RenderedPanorama HomeRenderer::RenderView(int camera_idx, const Camera& view,
                                          const Eigen::Matrix3d& pano_from_view,
                                          RunContext& context) const {
  ENFILADE_CHECK(view.model == CameraModel::kPinhole);
  uint64_t seed = PartSeed(home().seed + 3, static_cast<uint64_t>(camera_idx));
  for (const double entry : pano_from_view.reshaped())
    seed = PartSeed(seed, std::bit_cast<uint64_t>(entry));
  return RenderPicture(camera_idx, view, pano_from_view, seed, context);
}

RenderedPanorama HomeRenderer::RenderPicture(int camera_idx, const Camera& camera,
                                             const Eigen::Matrix3d& pano_from_cam, uint64_t seed,
                                             RunContext& context) const {
  const auto storey_idx = static_cast<size_t>(home().StoreyOfCamera(camera_idx));
  const LitStorey& lit = *storeys_[storey_idx];
  const HomeCamera& home_camera = home().cameras[static_cast<size_t>(camera_idx)];
  const Rigid3& home_from_pano = home_camera.home_from_cam;
  const bool is_panorama = camera.model == CameraModel::kEquirectangular;
  const double stand_share = is_panorama ? lit.options.stand_share : 0;
  std::vector<Eigen::Vector2d> offsets = SampleOffsets(lit.options.samples_per_pixel);
  offsets.emplace_back(0.5, 0.5);
  const ImageSize size{camera.width, camera.height};
  const PixelJob job{
      .lit = lit,
      .size = size,
      .origin = home_from_pano.translation.cast<float>(),
      .world_from_home = home().home_from_world.rotation.transpose(),
      .stand_share = stand_share,
      .stand_shares = StandShares(stand_share, size.width, Random(seed).Uniform()),
      .exposure =
          static_cast<float>(home_camera.exposure) * lit.exposure_of_room.at(home_camera.room_id),
      .rays = PixelRays(camera, home_from_pano.rotation * pano_from_cam, std::move(offsets))};
  RenderedPanorama out = BlankPanorama(size);
  ImageF ideal(size.height, size.width, 3);
  ParallelFor(context, is_panorama ? "panorama" : "view", size.height,
              [&](int64_t row) { RenderRow(job, static_cast<int>(row), ideal, out); });
  out.rgb =
      ExposeSensor(std::move(ideal), lit.options.blur_px, lit.options.noise, is_panorama, seed);
  return out;
}

}  // namespace enfilade
