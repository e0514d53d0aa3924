// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/exchange/colmap_writer.h"
#include "enfilade/image/codec.h"
#include "enfilade/scene/virtual_view.h"
#include "src/exchange/colmap_rig.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

constexpr int kJpegQuality = 92;

ImageU8 ReadPanorama(const View& view) {
  ImageU8 panorama = ReadImageRgb(view.path);
  if (panorama.cols() != view.camera.width || panorama.rows() != view.camera.height) {
    throw InvalidInputError(
        view.path.native(),
        fmt::format("is {} x {} pixels, its camera has {} x {}", panorama.cols(), panorama.rows(),
                    view.camera.width, view.camera.height),
        "read the scene again");
  }
  return panorama;
}

}  // namespace

void RenderRigPictures(const fs::path& folder, const Scene& scene, RunContext& context) {
  const std::vector<std::string> names = RigPictureNames(scene);
  ParallelFor(context, "render views", static_cast<int64_t>(scene.views.size()), [&](int64_t i) {
    const View& view = scene.views[static_cast<size_t>(i)];
    const std::string& name = names[static_cast<size_t>(i)];
    if (view.camera.model == CameraModel::kPinhole) {
      WriteFileAtomic(folder / name, ReadFile(view.path));
      return;
    }
    const ColmapRig rig = RigFor(scene);
    const ImageU8 panorama = ReadPanorama(view);
    for (const ColmapRigSlot& slot : rig.slots) {
      context.CheckStop();
      WriteImage(folder / (slot.prefix + name),
                 RenderVirtualView(panorama, view.camera, rig.camera, slot.pano_from_view),
                 kJpegQuality);
    }
  });
}

}  // namespace enfilade
