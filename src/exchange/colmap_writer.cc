// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/colmap_writer.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

#include "enfilade/base/errors.h"
#include "src/exchange/colmap_from_scene.h"
#include "src/exchange/colmap_rig.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

constexpr char kRigConfig[] = "rig_config.json";

// What another model left in the folder and readers would take for a part of this one.
void RemoveRest(const fs::path& folder, bool has_rig, ColmapEncoding encoding) {
  const std::string written = encoding == ColmapEncoding::kText ? ".txt" : ".bin";
  const std::string other = encoding == ColmapEncoding::kText ? ".bin" : ".txt";
  std::vector<std::string> names;
  for (const char* stem : {"cameras", "images", "points3D", "rigs", "frames"}) {
    names.push_back(stem + other);
  }
  names.insert(names.end(), {"rigs" + written, "frames" + written});
  if (!has_rig) names.push_back(kRigConfig);
  for (const std::string& name : names) {
    std::error_code error;
    fs::remove(folder / name, error);
    if (error) {
      throw IoError((folder / name).native(), "belongs to an older model and cannot be removed",
                    "remove it or name another folder");
    }
  }
}

}  // namespace

void WriteColmapModel(const fs::path& folder, const Scene& scene, ColmapForm form,
                      ColmapEncoding encoding) {
  const ColmapModel model = ColmapFromScene(scene, form);
  const bool has_rig = form == ColmapForm::kPinholeRig &&
                       std::any_of(scene.views.begin(), scene.views.end(), [](const View& view) {
                         return view.camera.model == CameraModel::kEquirectangular;
                       });
  encoding == ColmapEncoding::kText ? WriteColmapText(folder, model)
                                    : WriteColmapBinary(folder, model);
  if (has_rig) WriteRigConfig(folder / kRigConfig, RigFor(scene));
  RemoveRest(folder, has_rig, encoding);
}

}  // namespace enfilade
