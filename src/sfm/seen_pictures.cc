// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/seen_pictures.h"

#include <optional>
#include <utility>

#include "enfilade/geometry/angles.h"
#include "enfilade/image/codec.h"
#include "enfilade/sfm/colmap_features.h"
#include "src/sfm/component_heading.h"
#include "src/sfm/pixel_of_ray.h"
#include "src/sfm/seen_picture.h"
#include "src/sfm/wall_matches.h"

namespace enfilade {
namespace {

using Rgb = Eigen::Matrix<uint8_t, 3, 1>;

std::vector<Rgb> ColoursOf(std::span<const Eigen::Vector3f> rays, const ImageU8& picture,
                           const Camera& camera) {
  std::vector<Rgb> colours;
  for (const Eigen::Vector3f& ray : rays) {
    const uint8_t* rgb = PixelOfRay(picture, camera, ray.cast<double>());
    colours.emplace_back(rgb[0], rgb[1], rgb[2]);
  }
  return colours;
}

Gravity GravityAndHeading(std::span<const LineSegment> segments, const View& view) {
  Gravity gravity = FindGravityOfPicture(segments, view.told_up_in_cam);
  gravity.heading_rad = FindHeading(LevelLines(segments, LevelFromCam(gravity)));
  return gravity;
}

FloorPicture FloorOf(const ImageU8& picture, const ImageU8& trusted, const View& view,
                     const Gravity& gravity) {
  if (!gravity.heading_rad) return {};
  return LookAtFloor(picture, trusted, view.camera, CamFromWalls(gravity));
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
  seen.segments = FindLineSegments(picture, trusted, view.camera);
  const Gravity gravity = GravityAndHeading(seen.segments, view);
  seen.features = ExtractFeatures(picture, trusted, view.camera, CamFromWalls(gravity), options);
  seen.colours = ColoursOf(seen.features.rays, picture, view.camera);
  seen.floor = FloorOf(picture, trusted, view, gravity);
  SaveSeenPicture(file, key, seen);
  return seen;
}

// Likewise, but for the features, which COLMAP finds with what this tells.
SeenPicture LookAtLines(const View& view, const Stand& stand) {
  const ImageU8 picture = ReadImageRgb(view.path), trusted = TrustedPixels(view, stand);
  SeenPicture seen;
  seen.segments = FindLineSegments(picture, trusted, view.camera);
  const Gravity gravity = GravityAndHeading(seen.segments, view);
  seen.floor = FloorOf(picture, trusted, view, gravity);
  return seen;
}

}  // namespace

SeenPictures LookAtPictures(const Scene& scene, std::span<const Keyframe> keyframes,
                            const FeatureOptions& features, const StandOptions& stand_options,
                            const std::filesystem::path& work_folder, const std::string& program,
                            RunContext& context) {
  const size_t num_views = scene.views.size();
  const Stand stand = FindStandOfScene(scene, stand_options, context);
  SeenPictures seen{std::vector<PanoFeatures>(num_views), std::vector<std::vector<Rgb>>(num_views),
                    std::vector<Gravity>(num_views),
                    std::vector<std::vector<LineSegment>>(num_views),
                    std::vector<FloorPicture>(num_views)};
  const bool use_colmap = ChooseFeatureSource(features) == FeatureSource::kColmap;
  const auto is_panorama = [&](size_t i) {
    return scene.views[i].camera.model == CameraModel::kEquirectangular;
  };
  ParallelFor(context, use_colmap ? "find lines" : "find features", static_cast<int64_t>(num_views),
              [&](int64_t k) {
                const size_t i = static_cast<size_t>(k);
                const View& view = scene.views[i];
                if (!is_panorama(i)) return;
                SeenPicture picture = use_colmap ? LookAtLines(view, stand)
                                                 : LookAtPicture(view, stand, features,
                                                                 work_folder / "features", program);
                seen.gravity[i] = GravityAndHeading(picture.segments, view);
                seen.features[i] = std::move(picture.features);
                seen.colours[i] = std::move(picture.colours);
                seen.segments[i] = std::move(picture.segments);
                seen.floors[i] = std::move(picture.floor);
              });
  if (use_colmap) {
    std::vector<Eigen::Matrix3d> cam_from_walls;
    for (const Gravity& gravity : seen.gravity) cam_from_walls.push_back(CamFromWalls(gravity));
    seen.features = ExtractFeaturesWithColmap(scene.views, cam_from_walls, stand, features,
                                              work_folder / "database.db", context);
  }
  // What was followed becomes the last features, without descriptors.
  for (size_t i = 0; i < keyframes.size(); ++i) {
    std::vector<Eigen::Vector3f>& rays = seen.features[i].rays;
    if (is_panorama(i)) rays.insert(rays.end(), keyframes[i].rays.begin(), keyframes[i].rays.end());
  }
  return seen;
}

void FindMissingColours(const Scene& scene, RunContext& context, SeenPictures& seen) {
  std::vector<size_t> missing;
  for (size_t i = 0; i < seen.features.size(); ++i) {
    if (seen.colours[i].size() < seen.features[i].rays.size()) missing.push_back(i);
  }
  ParallelFor(context, "find colours", static_cast<int64_t>(missing.size()), [&](int64_t k) {
    const size_t i = missing[static_cast<size_t>(k)];
    const View& view = scene.views[i];
    seen.colours[i] = ColoursOf(seen.features[i].rays, ReadImageRgb(view.path), view.camera);
  });
}

ScenePoint PointOfTrack(const Track& track, const SeenPictures& seen, std::span<const View> views) {
  const Observation& first = track.observations.front();
  ScenePoint point;
  point.position = track.position;
  point.rgb =
      seen.colours[static_cast<size_t>(first.view_idx)][static_cast<size_t>(first.feature_idx)];
  for (const Observation& observation : track.observations) {
    const size_t view = static_cast<size_t>(observation.view_idx);
    const Eigen::Vector3f& ray =
        seen.features[view].rays[static_cast<size_t>(observation.feature_idx)];
    point.view_idx.push_back(observation.view_idx);
    point.pixels.push_back(views[view].camera.PixelFromRay(ray.cast<double>())->cast<float>());
  }
  return point;
}

}  // namespace enfilade
