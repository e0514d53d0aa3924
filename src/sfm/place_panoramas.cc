// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/place_panoramas.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "enfilade/base/check.h"
#include "enfilade/image/codec.h"
#include "enfilade/sfm/colmap_features.h"
#include "enfilade/sfm/gravity.h"
#include "src/sfm/component_heading.h"
#include "src/sfm/pixel_of_ray.h"
#include "src/sfm/seen_picture.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;
using Rgb = Eigen::Matrix<uint8_t, 3, 1>;

// What is kept of the pictures.
struct Seen {
  std::vector<PanoFeatures> features;
  std::vector<std::vector<Rgb>> colours;  // of the features
  std::vector<Gravity> gravity;
  std::vector<std::vector<LineSegment>> segments;
};

std::vector<Rgb> ColoursOf(const PanoFeatures& features, const ImageU8& picture,
                           const Camera& camera) {
  std::vector<Rgb> colours;
  for (const Eigen::Vector3f& ray : features.rays) {
    const uint8_t* rgb = PixelOfRay(picture, camera, ray.cast<double>());
    colours.emplace_back(rgb[0], rgb[1], rgb[2]);
  }
  return colours;
}

// What OpenCV sees of a panorama, from the file that a stopped run left where there is one.
SeenPicture LookAtPicture(const View& view, const Stand& stand, const FeatureOptions& options,
                          const std::filesystem::path& folder, const std::string& program) {
  const ImageU8 trusted = TrustedPixels(view, stand);
  const std::filesystem::path file = SeenPictureFile(folder, view);
  const std::string key = SeenPictureKey(view, trusted, options, program);
  if (std::optional<SeenPicture> known = LoadSeenPicture(file, key)) return std::move(*known);
  const ImageU8 picture = ReadImageRgb(view.path);
  SeenPicture seen;
  seen.features = ExtractFeatures(picture, trusted, view.camera, options);
  seen.colours = ColoursOf(seen.features, picture, view.camera);
  seen.segments = FindLineSegments(picture, trusted, view.camera);
  SaveSeenPicture(file, key, seen);
  return seen;
}

// What is wanted besides features that COLMAP has found.
SeenPicture LookAtPicture(const View& view, const Stand& stand, PanoFeatures features) {
  const ImageU8 picture = ReadImageRgb(view.path);
  SeenPicture seen;
  seen.features = std::move(features);
  seen.colours = ColoursOf(seen.features, picture, view.camera);
  seen.segments = FindLineSegments(picture, TrustedPixels(view, stand), view.camera);
  return seen;
}

Seen LookAtPictures(const Scene& scene, const PlaceOptions& options,
                    const std::filesystem::path& work_folder, const std::string& program,
                    RunContext& context) {
  const size_t num_views = scene.views.size();
  const Stand stand = FindStandOfScene(scene, options.stand, context);
  Seen seen{std::vector<PanoFeatures>(num_views), std::vector<std::vector<Rgb>>(num_views),
            std::vector<Gravity>(num_views), std::vector<std::vector<LineSegment>>(num_views)};
  const bool use_colmap = ChooseFeatureSource(options.features) == FeatureSource::kColmap;
  if (use_colmap) {
    seen.features = ExtractFeaturesWithColmap(scene.views, stand, options.features,
                                              work_folder / "database.db", context);
  }
  ParallelFor(context, use_colmap ? "find lines" : "find features", static_cast<int64_t>(num_views),
              [&](int64_t k) {
                const size_t i = static_cast<size_t>(k);
                const View& view = scene.views[i];
                SeenPicture picture = use_colmap
                                          ? LookAtPicture(view, stand, std::move(seen.features[i]))
                                          : LookAtPicture(view, stand, options.features,
                                                          work_folder / "features", program);
                seen.features[i] = std::move(picture.features);
                seen.colours[i] = std::move(picture.colours);
                seen.segments[i] = std::move(picture.segments);
                seen.gravity[i] = FindGravity(seen.segments[i], {0, -1, 0});
                seen.gravity[i].heading_rad =
                    FindHeading(LevelLines(seen.segments[i], LevelFromCam(seen.gravity[i])));
              });
  return seen;
}

// Turns and moves each component so that its walls run along x and y and its cameras' mean is the
// origin. Returns world_from_component.
std::vector<Rigid3> AlignComponents(const Seen& seen, const Registration& registration) {
  const int num_components =
      1 + *std::max_element(registration.component_idx.begin(), registration.component_idx.end());
  std::vector<Rigid3> world_from_component;
  for (int component = 0; component < num_components; ++component) {
    std::vector<LevelLine> lines;
    Vector3d sum = Vector3d::Zero();
    double count = 0;
    for (size_t i = 0; i < seen.features.size(); ++i) {
      if (registration.component_idx[i] != component) continue;
      const Rigid3& pose = registration.world_from_cam[i];
      const std::vector<LevelLine> own = LevelLines(seen.segments[i], pose.rotation);
      lines.insert(lines.end(), own.begin(), own.end());
      sum += Vector3d(pose.translation.x(), pose.translation.y(), 0);
      count += 1;
    }
    const Eigen::Matrix3d rotation = RotationZ(-FindHeading(lines).value_or(0));
    world_from_component.push_back({rotation, -(rotation * (sum / count))});
  }
  return world_from_component;
}

void SetPoses(const Registration& registration, std::span<const Rigid3> world_from_component,
              double camera_height_m, Scene& scene) {
  for (size_t i = 0; i < scene.views.size(); ++i) {
    View& view = scene.views[i];
    view.component_idx = registration.component_idx[i];
    view.storey_idx = view.component_idx;
    view.world_from_cam = world_from_component[static_cast<size_t>(view.component_idx)] *
                          registration.world_from_cam[i];
    view.world_from_cam.translation *= camera_height_m;
  }
}

void SetPoints(const Seen& seen, const Registration& registration,
               std::span<const Rigid3> world_from_component, double camera_height_m, Scene& scene) {
  scene.points.clear();
  for (const Track& track : registration.tracks) {
    const Observation& first = track.observations.front();
    const int component = registration.component_idx[static_cast<size_t>(first.view_idx)];
    ScenePoint point;
    point.position =
        camera_height_m * (world_from_component[static_cast<size_t>(component)] * track.position);
    point.rgb =
        seen.colours[static_cast<size_t>(first.view_idx)][static_cast<size_t>(first.feature_idx)];
    for (const Observation& observation : track.observations) {
      const size_t view = static_cast<size_t>(observation.view_idx);
      const Eigen::Vector3f& ray =
          seen.features[view].rays[static_cast<size_t>(observation.feature_idx)];
      point.view_idx.push_back(observation.view_idx);
      point.pixels.push_back(
          scene.views[view].camera.PixelFromRay(ray.cast<double>())->cast<float>());
    }
    scene.points.push_back(std::move(point));
  }
}

}  // namespace

PlaceReport PlacePanoramas(const PlaceOptions& options, const std::filesystem::path& work_folder,
                           const std::string& program, RunContext& context, Scene& scene) {
  ENFILADE_CHECK(!scene.views.empty());
  const Seen seen = LookAtPictures(scene, options, work_folder, program, context);
  PlaceReport report;
  report.registration =
      RegisterFeatures(seen.features, seen.gravity, options.registration, context);
  report.scale =
      FindMetricScale(scene.camera_height_m, report.registration.ceilings, options.scale);
  report.warnings = report.scale.warnings;
  for (const PanoFeatures& features : seen.features) report.num_features.push_back(features.size());

  const std::vector<Rigid3> world_from_component = AlignComponents(seen, report.registration);
  const double camera_height_m = report.scale.camera_height_m;
  SetPoses(report.registration, world_from_component, camera_height_m, scene);
  SetPoints(seen, report.registration, world_from_component, camera_height_m, scene);
  scene.scale_source = report.scale.source;
  scene.camera_height_m = camera_height_m;
  for (const std::string& warning : report.warnings) context.log().Warning(warning);
  return report;
}

}  // namespace enfilade
