// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/synthetic/write_home.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/base/hash.h"
#include "enfilade/base/json.h"
#include "enfilade/exchange/avi_writer.h"
#include "enfilade/exchange/floorplan_json.h"
#include "enfilade/exchange/npy.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/image/codec.h"
#include "enfilade/scene/camera.h"
#include "enfilade/synthetic/film.h"
#include "enfilade/synthetic/fixture_points.h"
#include "enfilade/synthetic/truth.h"
#include "enfilade/synthetic/write_cloud.h"

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
    if (options.kind != PictureKind::kPerspective) {
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

// Takes away what an earlier home left: what says that it is whole first, then pictures that this
// home lacks.
void RemoveOldHome(const fs::path& folder, const std::vector<Picture>& pictures) {
  for (const char* name : {"transforms.json", "video.avi", "truth/frames.csv"})
    RemoveFile(folder / name);
  RemoveClouds(folder);
  if (!fs::exists(folder / "panos")) return;
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

// Where, what and how the pictures of a home are to be made.
struct Shoot {
  const fs::path& folder;
  const Home& home;  // of a film, with one camera a frame
  const WriteHomeOptions& options;
  std::vector<Picture> pictures;
};

// Renders a picture and tells the truth about it. Returns its JPEG file.
std::string Take(const Shoot& shoot, const HomeRenderer& renderer, const Picture& picture,
                 Floorplan& truth, RunContext& context) {
  const RenderedPanorama rendered = RenderPicture(renderer, picture, context);
  std::string jpeg = EncodeImage(rendered.rgb, ".jpg", shoot.options.jpeg_quality);
  PlanCamera camera;
  camera.picture = picture.name;
  camera.sha256 = Sha256(jpeg);
  camera.storey_idx = shoot.home.StoreyOfCamera(picture.camera_idx);
  camera.world_from_cam = PoseOf(picture, shoot.home.WorldFromCamera(picture.camera_idx));
  truth.cameras.push_back(camera);
  if (shoot.options.has_pixel_truth) {
    WritePixelTruth(shoot.folder / "truth", fs::path(picture.name).stem().native(), rendered);
  }
  return jpeg;
}

void WriteTruth(const Shoot& shoot, const Floorplan& truth) {
  WriteFloorplanJson(shoot.folder / "truth" / "floorplan.json", truth,
                     {{"synthetic_seed", shoot.home.seed}});
}

void WritePanoramas(const Shoot& shoot, const HomeRenderer& renderer, Floorplan truth,
                    RunContext& context) {
  for (const Picture& picture : shoot.pictures) {
    WriteFileAtomic(shoot.folder / "panos" / picture.name,
                    Take(shoot, renderer, picture, truth, context));
  }
  WriteTruth(shoot, truth);
  WriteJsonFile(shoot.folder / "transforms.json", Transforms(shoot.home, shoot.pictures));
}

std::string FramesCsv(const Floorplan& truth, double frames_per_second) {
  std::string csv = "file,x,y,z,qw,qx,qy,qz,time_s\n";
  for (size_t i = 0; i < truth.cameras.size(); ++i) {
    const Rigid3& pose = truth.cameras[i].world_from_cam;
    const Eigen::Vector3d& t = pose.translation;
    const Eigen::Quaterniond q(pose.rotation);
    csv += fmt::format("{},{:.9f},{:.9f},{:.9f},{:.12f},{:.12f},{:.12f},{:.12f},{:.6f}\n",
                       truth.cameras[i].picture, t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z(),
                       static_cast<double>(i) / frames_per_second);
  }
  return csv;
}

void WriteVideo(const Shoot& shoot, const HomeRenderer& renderer, Floorplan truth,
                RunContext& context) {
  const double frames_per_second = shoot.options.frames_per_second;
  WriteFileAtomic(shoot.folder / "video.avi", [&](const fs::path& temporary) {
    AviWriter video(temporary, {shoot.options.width, shoot.options.width / 2}, frames_per_second);
    for (const Picture& frame : shoot.pictures)
      video.AddFrame(Take(shoot, renderer, frame, truth, context));
    video.Finish();
    WriteTruth(shoot, truth);
    WriteFileAtomic(shoot.folder / "truth" / "frames.csv", FramesCsv(truth, frames_per_second));
  });
}

void CheckWidth(int width, const RunContext& context) {
  if (width % 2 != 0) {
    throw InvalidInputError("width", "is odd", "give an even number: panoramas are 2:1");
  }
  if (width < 64) {
    throw InvalidInputError("width", "is too small", "give 64 pixels or more");
  }
  const double need_mb = PictureMemoryMb(width);
  if (width > kMaxWidth) {
    throw InvalidInputError(
        "width", fmt::format("{} pixels would take {:.0f} GB of memory", width, need_mb / 1000),
        fmt::format("give {} or less", kMaxWidth));
  }
  if (context.max_memory_mb() > 0 && need_mb > context.max_memory_mb()) {
    throw InvalidInputError("--max-memory",
                            fmt::format("{} MB are too few: pictures {} pixels wide take {:.0f} MB",
                                        context.max_memory_mb(), width, need_mb),
                            "allow more, or give a smaller width");
  }
}

}  // namespace

std::span<const std::string_view> EnumNames(PictureKind) {
  static constexpr std::array<std::string_view, 3> kNames = {"equirectangular", "perspective",
                                                             "video"};
  return kNames;
}

void WriteHome(const fs::path& folder, const Home& home, const WriteHomeOptions& options,
               RunContext& context) {
  WriteHomeOptions checked = options;
  ValidateOptions(VisitorOf(checked), "synthetic home");
  CheckWidth(options.width, context);
  const bool is_video = options.kind == PictureKind::kVideo;
  if (options.has_points && options.kind != PictureKind::kEquirectangular) {
    throw InvalidInputError("has_points", "is for panoramas", "give the kind equirectangular");
  }
  const Home shot = is_video ? FilmWalk(home, options.frames_per_second) : home;
  const Shoot shoot{folder, shot, options, ListPictures(shot, options)};
  CreateFolder(folder / "truth");  // first: it marks what may be replaced, even if this is killed
  if (!is_video) CreateFolder(folder / "panos");
  RemoveOldHome(folder, is_video ? std::vector<Picture>() : shoot.pictures);

  const HomeRenderer renderer(shot, options.render, context);
  if (options.has_points) {
    PointNoise noise;
    noise.seed = home.seed;
    WriteClouds(folder, home, FixturePoints(home, noise));
  }
  Floorplan truth = TruthFloorplan(shot);
  truth.cameras.clear();
  if (is_video) {
    WriteVideo(shoot, renderer, std::move(truth), context);
  } else {
    WritePanoramas(shoot, renderer, std::move(truth), context);
  }
}

}  // namespace enfilade
