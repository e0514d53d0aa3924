// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/colmap_from_scene.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "enfilade/base/check.h"
#include "src/exchange/colmap_rig.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
namespace fs = std::filesystem;

// The deepest folder that holds all pictures.
fs::path CommonFolder(const Scene& scene) {
  std::optional<fs::path> common;
  for (const View& view : scene.views) {
    const fs::path folder = view.path.lexically_normal().parent_path();
    if (!common) common = folder;
    const auto end =
        std::mismatch(common->begin(), common->end(), folder.begin(), folder.end()).first;
    fs::path shared;
    for (auto it = common->begin(); it != end; ++it) shared /= *it;
    common = shared;
  }
  return common.value_or(fs::path());
}

std::vector<std::string> NamesBelowCommonFolder(const Scene& scene) {
  const fs::path common = CommonFolder(scene);
  std::vector<std::string> names;
  for (const View& view : scene.views) {
    const fs::path below = view.path.lexically_normal().lexically_relative(common);
    names.push_back(view.path.empty() ? view.picture : below.generic_string());
  }
  ENFILADE_CHECK(std::set<std::string>(names.begin(), names.end()).size() == names.size());
  return names;
}

// Builds a model view by view, then point by point.
class ModelBuilder {
 public:
  // Without a rig, panoramas stay what they are.
  ModelBuilder(const Scene& scene, const std::optional<ColmapRig>& rig) : scene_(scene), rig_(rig) {
    if (!rig_) return;
    for (size_t k = 0; k < rig_->slots.size(); ++k) {
      model_.cameras[static_cast<uint32_t>(k + 1)] = rig_->camera;
    }
  }

  void AddView(const View& view, const std::string& name) {
    first_image_.push_back(model_.images.size());
    if (!rig_ || !IsPanorama(view)) {
      AddImage(view.world_from_cam, CameraId(view.camera), name);
      return;
    }
    for (size_t k = 0; k < rig_->slots.size(); ++k) {
      const Rigid3 cam_from_view{rig_->slots[k].pano_from_view, Vector3d::Zero()};
      AddImage(view.world_from_cam * cam_from_view, static_cast<uint32_t>(k + 1),
               rig_->slots[k].prefix + name);
    }
  }

  void AddPoint(const ScenePoint& point) {
    ENFILADE_CHECK(point.pixels.empty() || point.pixels.size() == point.view_idx.size());
    ColmapPoint made;
    made.id = model_.points.size() + 1;
    made.position = point.position;
    made.rgb = point.rgb;
    double sum_px = 0;
    for (size_t k = 0; k < point.view_idx.size(); ++k) {
      const auto view_idx = static_cast<size_t>(point.view_idx[k]);
      ENFILADE_CHECK(point.view_idx[k] >= 0 && view_idx < scene_.views.size());
      const std::optional<Vector2d> pixel = PixelOf(point, k);
      if (pixel) sum_px += AddObservation(view_idx, *pixel, made);
    }
    const double mean_px = sum_px / static_cast<double>(made.track.size());
    if (!point.pixels.empty() && std::isfinite(mean_px)) made.error_px = mean_px;
    model_.points.push_back(std::move(made));
  }

  [[nodiscard]] ColmapModel Take() { return std::move(model_); }

 private:
  [[nodiscard]] uint32_t CameraId(const Camera& camera) {
    const auto key = [](const Camera& c) {
      return std::tuple(c.model, c.width, c.height, c.fx, c.fy, c.cx, c.cy);
    };
    const uint32_t first_free = rig_ ? static_cast<uint32_t>(rig_->slots.size() + 1) : 1;
    uint32_t id = first_free;
    while (model_.cameras.contains(id) && key(model_.cameras[id]) != key(camera)) ++id;
    model_.cameras[id] = camera;
    return id;
  }

  void AddImage(const Rigid3& world_from_image, uint32_t camera_id, std::string name) {
    ColmapImage image;
    image.id = static_cast<uint32_t>(model_.images.size() + 1);
    image.camera_id = camera_id;
    image.cam_from_world = world_from_image.Inverse();
    image.name = std::move(name);
    model_.images.push_back(std::move(image));
  }

  // Where the k-th view of a point shows it, or would.
  [[nodiscard]] std::optional<Vector2d> PixelOf(const ScenePoint& point, size_t k) const {
    if (!point.pixels.empty()) return point.pixels[k].cast<double>();
    const View& view = scene_.views[static_cast<size_t>(point.view_idx[k])];
    return view.camera.PixelFromRay(view.world_from_cam.Inverse() * point.position);
  }

  // Returns how far the point's projection is from the observation, in pixels.
  double AddObservation(size_t view_idx, const Vector2d& pixel, ColmapPoint& point) {
    const View& view = scene_.views[view_idx];
    size_t image_idx = first_image_[view_idx];
    Vector2d pixel_in_image = pixel;
    if (rig_ && IsPanorama(view)) {
      const Vector3d ray = view.camera.RayFromPixel(pixel);
      const size_t slot = rig_->SlotOf(ray);
      image_idx += slot;
      pixel_in_image = Project(rig_->camera, rig_->slots[slot].pano_from_view.transpose() * ray);
    }
    ColmapImage& image = model_.images[image_idx];
    point.track.push_back({image.id, static_cast<uint32_t>(image.points2d.size())});
    image.points2d.push_back({pixel_in_image, point.id});
    return ErrorPx(image, point.position, pixel_in_image);
  }

  // Also beyond the border of a pinhole camera's picture.
  static Vector2d Project(const Camera& camera, const Vector3d& ray) {
    return {camera.fx * ray.x() / ray.z() + camera.cx, camera.fy * ray.y() / ray.z() + camera.cy};
  }

  [[nodiscard]] double ErrorPx(const ColmapImage& image, const Vector3d& position,
                               const Vector2d& pixel) const {
    const Camera& camera = model_.cameras.at(image.camera_id);
    const Vector3d ray = image.cam_from_world * position;
    if (camera.model == CameraModel::kPinhole) return (Project(camera, ray) - pixel).norm();
    Vector2d error = *camera.PixelFromRay(ray) - pixel;
    error.x() -= camera.width * std::round(error.x() / camera.width);
    return error.norm();
  }

  const Scene& scene_;
  const std::optional<ColmapRig>& rig_;
  ColmapModel model_;
  std::vector<size_t> first_image_;  // of every view
};

}  // namespace

ColmapModel ColmapFromScene(const Scene& scene, ColmapForm form) {
  const bool has_panorama = std::any_of(scene.views.begin(), scene.views.end(), IsPanorama);
  std::optional<ColmapRig> rig;
  if (form == ColmapForm::kPinholeRig && has_panorama) rig = RigFor(scene);
  const std::vector<std::string> names =
      form == ColmapForm::kPinholeRig ? RigPictureNames(scene) : NamesBelowCommonFolder(scene);
  ModelBuilder builder(scene, rig);
  for (size_t i = 0; i < scene.views.size(); ++i) builder.AddView(scene.views[i], names[i]);
  for (const ScenePoint& point : scene.points) builder.AddPoint(point);
  return builder.Take();
}

}  // namespace enfilade
