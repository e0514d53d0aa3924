// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/synthetic/write_cloud.h"

#include <string>
#include <system_error>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/exchange/colmap_writer.h"
#include "enfilade/exchange/ply_writer.h"
#include "enfilade/exchange/point_cloud_writer.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

constexpr char kPly[] = "dense/fused.ply", kVis[] = "dense/fused.ply.vis",
               kModel[] = "dense/sparse";
constexpr char kPatches[] = "pmvs/models/option-0000.patch";
constexpr char kPatchColours[] = "pmvs/models/option-0000.ply";
constexpr char kImageList[] = "pmvs/bundle.rd.out.list.txt";

// The poses as they are told, without points.
Scene ClaimedScene(const Home& home) {
  Scene scene;
  for (size_t i = 0; i < home.cameras.size(); ++i) {
    View view;
    view.picture = home.cameras[i].picture;
    view.camera = EquirectangularCamera(2048, 1024);
    view.world_from_cam = home.ClaimedWorldFromCamera(static_cast<int>(i));
    scene.views.push_back(view);
  }
  return scene;
}

}  // namespace

void WriteClouds(const fs::path& folder, const Home& home, std::span<const ScenePoint> points) {
  WriteColmapModel(folder / kModel, ClaimedScene(home), ColmapForm::kEquirectangular,
                   ColmapEncoding::kBinary);
  WriteVisibility(folder / kVis, points);
  WritePointsPly(folder / kPly, points);
  std::string names;
  for (const HomeCamera& camera : home.cameras) names += camera.picture + "\n";
  WriteFileAtomic(folder / kImageList, names);
  WritePointsPly(folder / kPatchColours, points);
  WritePatches(folder / kPatches, points);
}

void RemoveClouds(const fs::path& folder) {
  for (const char* name : {kPly, kVis, kPatches, kPatchColours, kImageList}) {
    std::error_code error;
    fs::remove(folder / name, error);
    if (error)
      throw IoError((folder / name).native(), "cannot be replaced", "choose another folder");
  }
}

}  // namespace enfilade
