// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/synthetic/write_home.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/base/hash.h"
#include "enfilade/base/json.h"
#include "enfilade/exchange/floorplan_json.h"
#include "enfilade/exchange/npy.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/image/codec.h"
#include "enfilade/scene/camera.h"
#include "enfilade/synthetic/truth.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int kMaxWidth = 16384;

// Memory that rendering a panorama of this width takes: colour before and after the lens' blur in
// floats, the picture, its truth and, measured, 90 MB besides.
double PictureMemoryMb(int width) {
  constexpr double kBytesPerPixel = 2 * 3 * sizeof(float) + 3 + 21, kBase_mb = 90;
  return kBase_mb + 1e-6 * kBytesPerPixel * 0.5 * width * width;
}

// OpenGL cameras look along −z with y up: half a turn about x.
Json TransformMatrix(const Rigid3& world_from_cam) {
  Rigid3 cam_from_gl;
  cam_from_gl.rotation.diagonal() << 1, -1, -1;
  const Eigen::Matrix4d matrix = (world_from_cam * cam_from_gl).Matrix();
  Json rows = Json::array();
  for (int r = 0; r < 4; ++r) {
    Json row = Json::array();
    for (int c = 0; c < 4; ++c) row.push_back(matrix(r, c) + 0.0);  // no −0
    rows.push_back(row);
  }
  return rows;
}

// A picture to be made.
struct Picture {
  std::string name;
  int camera_idx = 0;
  Camera camera;
  Eigen::Matrix3d pano_from_cam = Eigen::Matrix3d::Identity();
};

std::vector<Picture> ListPictures(const Home& home, const WriteHomeOptions& options) {
  constexpr int kViewsPerPlace = 8;
  const int side = options.width / 4;  // of a view of 90°
  std::vector<Picture> pictures;
  for (int i = 0; i < static_cast<int>(home.cameras.size()); ++i) {
    const std::string& name = home.cameras[static_cast<size_t>(i)].picture;
    if (options.kind == PictureKind::kEquirectangular) {
      pictures.push_back({name, i, EquirectangularCamera(options.width, options.width / 2)});
      continue;
    }
    for (int k = 0; k < kViewsPerPlace; ++k) {
      // About the camera's y axis, which points down: to the right.
      const Eigen::AngleAxisd turn(2 * kPi * k / kViewsPerPlace, Eigen::Vector3d::UnitY());
      pictures.push_back({fs::path(name).stem().native() + "_" + std::to_string(k) + ".jpg", i,
                          PinholeCamera(side, side, 0.5 * side, 0.5 * side, 0.5 * side, 0.5 * side),
                          turn.toRotationMatrix()});
    }
  }
  return pictures;
}

Rigid3 PoseOf(const Picture& picture, const Rigid3& world_from_pano) {
  return world_from_pano * Rigid3{picture.pano_from_cam, Eigen::Vector3d::Zero()};
}

Json Transforms(const Home& home, const std::vector<Picture>& pictures) {
  Json frames = Json::array();
  for (const Picture& picture : pictures) {
    const Rigid3 pose = PoseOf(picture, home.ClaimedWorldFromCamera(picture.camera_idx));
    frames.push_back(
        {{"file_path", "panos/" + picture.name}, {"transform_matrix", TransformMatrix(pose)}});
  }
  Json json = {{"up_axis", "z"}, {"units", "m"}, {"frames", frames}};
  if (pictures.empty()) return json;
  const Camera& camera = pictures[0].camera;
  json["w"] = camera.width;
  json["h"] = camera.height;
  json["camera_model"] = "EQUIRECTANGULAR";
  if (camera.model == CameraModel::kPinhole) {
    json["camera_model"] = "PINHOLE";
    json["fl_x"] = camera.fx;
    json["fl_y"] = camera.fy;
    json["cx"] = camera.cx;
    json["cy"] = camera.cy;
  }
  return json;
}

void RemoveFile(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error) throw IoError(path.native(), "cannot be replaced", "choose another folder");
}

// Takes away what an earlier home left: poses first, then pictures that this home lacks.
void RemoveOldHome(const fs::path& folder, const std::vector<Picture>& pictures) {
  RemoveFile(folder / "transforms.json");
  std::set<std::string> kept;
  for (const Picture& picture : pictures) kept.insert(picture.name);
  std::vector<fs::path> old;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "panos")) {
    const std::string name = entry.path().filename().native();
    const bool is_ours = name.starts_with("pano_") && name.ends_with(".jpg");
    if (is_ours && kept.count(name) == 0) old.push_back(entry.path());
  }
  for (const fs::path& path : old) RemoveFile(path);
}

Image<int8_t> QuantizeNormals(const ImageF& normal) {
  Image<int8_t> out(normal.rows(), normal.cols(), 3);
  for (size_t i = 0; i < out.data().size(); ++i) {
    out.data()[i] = static_cast<int8_t>(std::lround(127 * normal.data()[i]));
  }
  return out;
}

RenderedPanorama RenderPicture(const HomeRenderer& renderer, const Picture& picture,
                               RunContext& context) {
  const Camera& camera = picture.camera;
  return camera.model == CameraModel::kPinhole
             ? renderer.RenderView(picture.camera_idx, camera, picture.pano_from_cam, context)
             : renderer.Render(picture.camera_idx, {camera.width, camera.height}, context);
}

void WritePixelTruth(const fs::path& folder, const std::string& stem,
                     const RenderedPanorama& panorama) {
  WriteNpy(folder / "depth" / (stem + ".npy"), panorama.range_m);
  WriteNpy(folder / "normals" / (stem + ".npy"), QuantizeNormals(panorama.normal));
  WriteImage(folder / "labels" / (stem + ".png"), panorama.label);
  WriteNpy(folder / "rooms" / (stem + ".npy"), panorama.room_id);
  WriteNpy(folder / "walls" / (stem + ".npy"), panorama.wall_id);
}

}  // namespace

std::span<const std::string_view> EnumNames(PictureKind) {
  static constexpr std::array<std::string_view, 2> kNames = {"equirectangular", "perspective"};
  return kNames;
}

void WriteHome(const fs::path& folder, const Home& home, const WriteHomeOptions& options,
               RunContext& context) {
  WriteHomeOptions checked = options;
  ValidateOptions(VisitorOf(checked), "synthetic home");
  if (options.width % 2 != 0) {
    throw InvalidInputError("width", "is odd", "give an even number: panoramas are 2:1");
  }
  if (options.width < 64) {
    throw InvalidInputError("width", "is too small", "give 64 pixels or more");
  }
  const double need_mb = PictureMemoryMb(options.width);
  if (options.width > kMaxWidth) {
    throw InvalidInputError(
        "width",
        fmt::format("{} pixels would take {:.0f} GB of memory", options.width, need_mb / 1000),
        fmt::format("give {} or less", kMaxWidth));
  }
  if (context.max_memory_mb() > 0 && need_mb > context.max_memory_mb()) {
    throw InvalidInputError("--max-memory",
                            fmt::format("{} MB are too few: pictures {} pixels wide take {:.0f} MB",
                                        context.max_memory_mb(), options.width, need_mb),
                            "allow more, or give a smaller width");
  }
  const std::vector<Picture> pictures = ListPictures(home, options);
  CreateFolder(folder / "truth");  // first: it marks what may be replaced, even if this is killed
  CreateFolder(folder / "panos");
  RemoveOldHome(folder, pictures);

  const HomeRenderer renderer(home, options.render, context);
  Floorplan truth = TruthFloorplan(home);
  truth.cameras.clear();
  for (const Picture& picture : pictures) {
    const RenderedPanorama rendered = RenderPicture(renderer, picture, context);
    const std::string jpeg = EncodeImage(rendered.rgb, ".jpg", options.jpeg_quality);
    WriteFileAtomic(folder / "panos" / picture.name, jpeg);
    PlanCamera camera;
    camera.picture = picture.name;
    camera.sha256 = Sha256(jpeg);
    camera.storey_idx = home.StoreyOfCamera(picture.camera_idx);
    camera.world_from_cam = PoseOf(picture, home.WorldFromCamera(picture.camera_idx));
    truth.cameras.push_back(camera);
    if (options.has_pixel_truth)
      WritePixelTruth(folder / "truth", fs::path(picture.name).stem().native(), rendered);
  }
  WriteFloorplanJson(folder / "truth" / "floorplan.json", truth, {{"synthetic_seed", home.seed}});
  WriteJsonFile(folder / "transforms.json", Transforms(home, pictures));
}

}  // namespace enfilade
