// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/seen_pictures.h"

#include <optional>
#include <utility>

#include "enfilade/image/codec.h"
#include "enfilade/sfm/colmap_features.h"
#include "src/sfm/component_heading.h"
#include "src/sfm/pixel_of_ray.h"
#include "src/sfm/seen_picture.h"

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
  seen.colours = ColoursOf(seen.features.rays, picture, view.camera);
  seen.segments = FindLineSegments(picture, trusted, view.camera);
  SaveSeenPicture(file, key, seen);
  return seen;
}

// What is wanted besides features that COLMAP has found.
SeenPicture LookAtPicture(const View& view, const Stand& stand, PanoFeatures features) {
  const ImageU8 picture = ReadImageRgb(view.path);
  SeenPicture seen;
  seen.features = std::move(features);
  seen.colours = ColoursOf(seen.features.rays, picture, view.camera);
  seen.segments = FindLineSegments(picture, TrustedPixels(view, stand), view.camera);
  return seen;
}

// What was followed becomes the last features, without descriptors.
void AddFollowed(const View& view, std::span<const Eigen::Vector3f> rays, SeenPicture& seen) {
  const std::vector<Rgb> colours = ColoursOf(rays, ReadImageRgb(view.path), view.camera);
  seen.features.rays.insert(seen.features.rays.end(), rays.begin(), rays.end());
  seen.colours.insert(seen.colours.end(), colours.begin(), colours.end());
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
                    std::vector<std::vector<LineSegment>>(num_views)};
  const bool use_colmap = ChooseFeatureSource(features) == FeatureSource::kColmap;
  if (use_colmap) {
    seen.features = ExtractFeaturesWithColmap(scene.views, stand, features,
                                              work_folder / "database.db", context);
  }
  ParallelFor(context, use_colmap ? "find lines" : "find features", static_cast<int64_t>(num_views),
              [&](int64_t k) {
                const size_t i = static_cast<size_t>(k);
                const View& view = scene.views[i];
                if (view.camera.model != CameraModel::kEquirectangular) return;
                SeenPicture picture =
                    use_colmap
                        ? LookAtPicture(view, stand, std::move(seen.features[i]))
                        : LookAtPicture(view, stand, features, work_folder / "features", program);
                if (!keyframes.empty()) AddFollowed(view, keyframes[i].rays, picture);
                seen.features[i] = std::move(picture.features);
                seen.colours[i] = std::move(picture.colours);
                seen.segments[i] = std::move(picture.segments);
                seen.gravity[i] = FindGravityOfPicture(seen.segments[i], view.told_up_in_cam);
                seen.gravity[i].heading_rad =
                    FindHeading(LevelLines(seen.segments[i], LevelFromCam(seen.gravity[i])));
              });
  return seen;
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
