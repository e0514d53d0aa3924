// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/colmap_rig.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "enfilade/base/check.h"
#include "enfilade/base/json.h"
#include "enfilade/geometry/angles.h"
#include "src/exchange/colmap_model.h"

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
namespace fs = std::filesystem;

constexpr int kNumRound = 8;

// Columns are the view's right, down and forward in the panorama.
Matrix3d Axes(const Vector3d& right, const Vector3d& forward) {
  Matrix3d axes;
  axes << right, forward.cross(right), forward;
  return axes;
}

std::string WithoutWhiteSpace(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return c <= ' ' || c == 0x7F; }, '_');
  return name;
}

// The name, with a number after its stem where it is taken.
std::string MakeDistinct(const fs::path& stem, const fs::path& extension,
                         std::set<std::string>& taken) {
  std::string name = stem.native() + extension.native();
  for (int k = 2; !taken.insert(name).second; ++k) {
    name = fmt::format("{}_{}{}", stem.native(), k, extension.native());
  }
  return name;
}

}  // namespace

size_t ColmapRig::SlotOf(const Vector3d& ray_in_pano) const {
  const auto along = [&](const ColmapRigSlot& slot) {
    return slot.pano_from_view.col(2).dot(ray_in_pano);
  };
  const auto nearest = std::max_element(
      slots.begin(), slots.end(),
      [&](const ColmapRigSlot& a, const ColmapRigSlot& b) { return along(a) < along(b); });
  return static_cast<size_t>(nearest - slots.begin());
}

namespace {

// COLMAP 3.8's rig_bundle_adjuster aborts over a camera that shows no point.
void DropBlindSlots(const Scene& scene, ColmapRig& rig) {
  std::vector<bool> is_used(rig.slots.size(), false);
  for (const ScenePoint& point : scene.points) {
    for (size_t k = 0; k < point.view_idx.size(); ++k) {
      const View& view = scene.views[static_cast<size_t>(point.view_idx[k])];
      if (view.camera.model != CameraModel::kEquirectangular) continue;
      is_used[rig.SlotOf(point.pixels.empty()
                             ? Vector3d(view.world_from_cam.Inverse() * point.position)
                             : view.camera.RayFromPixel(point.pixels[k].cast<double>()))] = true;
    }
  }
  if (std::find(is_used.begin(), is_used.end(), true) == is_used.end()) return;
  std::vector<ColmapRigSlot> seeing;
  for (size_t k = 0; k < is_used.size(); ++k) {
    if (is_used[k]) seeing.push_back(std::move(rig.slots[k]));
  }
  rig.slots = std::move(seeing);
}

}  // namespace

ColmapRig RigFor(const Scene& scene) {
  int widest = 0;
  for (const View& view : scene.views) {
    if (view.camera.model == CameraModel::kEquirectangular) {
      widest = std::max(widest, view.camera.width);
    }
  }
  ENFILADE_CHECK(widest > 0);
  const int focal_px = static_cast<int>(std::ceil(widest / (2 * kPi)));
  ColmapRig rig{PinholeCamera(2 * focal_px, 2 * focal_px, focal_px, focal_px, focal_px, focal_px),
                {}};
  std::vector<Matrix3d> axes;
  for (int k = 0; k < kNumRound; ++k) {
    const double c = std::cos(2 * kPi * k / kNumRound), s = std::sin(2 * kPi * k / kNumRound);
    axes.push_back(Axes({c, 0, -s}, {s, 0, c}));
  }
  axes.push_back(Axes({1, 0, 0}, {0, -1, 0}));
  axes.push_back(Axes({1, 0, 0}, {0, 1, 0}));
  for (size_t k = 0; k < axes.size(); ++k) {
    rig.slots.push_back({fmt::format("view_{}/", k), axes[k]});
  }
  DropBlindSlots(scene, rig);
  return rig;
}

std::vector<std::string> RigPictureNames(const Scene& scene) {
  std::set<std::string> taken;
  std::vector<std::string> names;
  for (const View& view : scene.views) {
    const fs::path picture = WithoutWhiteSpace(view.picture);
    names.push_back(view.camera.model == CameraModel::kEquirectangular
                        ? MakeDistinct(picture.stem(), ".jpg", taken)
                        : MakeDistinct("photos" / picture.stem(), picture.extension(), taken));
  }
  return names;
}

void WriteRigConfig(const fs::path& path, const ColmapRig& rig) {
  nlohmann::json cameras = nlohmann::json::array();
  for (size_t k = 0; k < rig.slots.size(); ++k) {
    const Eigen::Vector4d q = ColmapQuaternion(rig.slots[k].pano_from_view.transpose());
    const nlohmann::json rotation{q[0], q[1], q[2], q[3]};
    const nlohmann::json translation{0.0, 0.0, 0.0};
    nlohmann::json camera{{"camera_id", k + 1},
                          {"image_prefix", rig.slots[k].prefix},
                          {"rel_qvec", rotation},
                          {"rel_tvec", translation}};
    if (k == 0) {
      camera["ref_sensor"] = true;
    } else {
      camera["cam_from_rig_rotation"] = rotation;
      camera["cam_from_rig_translation"] = translation;
    }
    cameras.push_back(std::move(camera));
  }
  WriteJsonFile(path, nlohmann::json::array({{{"ref_camera_id", 1}, {"cameras", cameras}}}));
}

}  // namespace enfilade
