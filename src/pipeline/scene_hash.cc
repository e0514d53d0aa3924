// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/pipeline/scene_hash.h"

#include <cstdint>
#include <span>
#include <string_view>

#include "enfilade/base/hash.h"
#include "src/pipeline/binary_file.h"

namespace enfilade {
namespace {

void AddText(BinaryWriter& writer, std::string_view text) {
  writer.Add(static_cast<uint64_t>(text.size()));
  writer.AddArray(std::span(text.data(), text.size()));
}

template <typename Derived>
void AddMatrix(BinaryWriter& writer, const Eigen::PlainObjectBase<Derived>& matrix) {
  writer.AddArray(std::span(matrix.data(), static_cast<size_t>(matrix.size())));
}

void AddView(BinaryWriter& writer, const View& view) {
  AddText(writer, view.picture);
  AddText(writer, view.sha256);
  AddText(writer, view.mask_path.empty() ? "" : Sha256OfFile(view.mask_path));
  const Camera& camera = view.camera;
  writer.Add(static_cast<int32_t>(camera.model));
  writer.Add(camera.width);
  writer.Add(camera.height);
  for (const double value : {camera.fx, camera.fy, camera.cx, camera.cy}) writer.Add(value);
  AddMatrix(writer, view.world_from_cam.rotation);
  AddMatrix(writer, view.world_from_cam.translation);
  writer.Add(view.storey_idx);
  writer.Add(view.component_idx);
  writer.Add(view.is_pose_inferred);
}

void AddPoint(BinaryWriter& writer, const ScenePoint& point) {
  AddMatrix(writer, point.position);
  AddMatrix(writer, point.normal);
  AddMatrix(writer, point.rgb);
  writer.Add(static_cast<uint64_t>(point.view_idx.size()));
  writer.AddArray(std::span(point.view_idx));
  writer.Add(static_cast<uint64_t>(point.pixels.size()));
  for (const Eigen::Vector2f& pixel : point.pixels) AddMatrix(writer, pixel);
}

}  // namespace

std::string SceneHash(const Scene& scene) {
  BinaryWriter writer("scene", 2);
  writer.Add(static_cast<uint64_t>(scene.views.size()));
  for (const View& view : scene.views) AddView(writer, view);
  writer.Add(static_cast<uint64_t>(scene.points.size()));
  for (const ScenePoint& point : scene.points) AddPoint(writer, point);
  writer.Add(static_cast<int32_t>(scene.pose_source));
  writer.Add(static_cast<int32_t>(scene.scale_source));
  writer.Add(scene.camera_height_m.has_value());
  writer.Add(scene.camera_height_m.value_or(0));
  return Sha256(writer.bytes());
}

}  // namespace enfilade
