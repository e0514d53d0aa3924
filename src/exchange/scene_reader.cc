// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/scene_reader.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <system_error>
#include <tuple>
#include <utility>

#include "enfilade/base/errors.h"
#include "enfilade/base/hash.h"
#include "enfilade/image/codec.h"
#include "enfilade/image/xmp.h"
#include "src/exchange/photo_sphere.h"
#include "src/exchange/picture_files.h"
#include "src/exchange/pose_file.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

constexpr double kStoreyGap_m = 1.8;
constexpr double kSamePosition_m = 0.01;
constexpr size_t kMaxNamed = 3;

// "a.jpg, b.jpg, c.jpg and 4 more"
std::string NameSome(const std::vector<std::string>& names) {
  std::string text;
  for (size_t i = 0; i < std::min(names.size(), kMaxNamed); ++i) {
    text += (i > 0 ? ", " : "") + names[i];
  }
  if (names.size() > kMaxNamed) text += fmt::format(" and {} more", names.size() - kMaxNamed);
  return text;
}

// The poses that the user names or that lie beside the pictures; none for pictures alone.
std::optional<PoseFile> FindAndReadPoses(const fs::path& folder, const SceneReadOptions& options) {
  if (options.poses == "none") return std::nullopt;
  const std::optional<PoseLocation> location =
      options.poses.empty() ? FindPoses(folder) : std::optional(LocatePoses(options.poses));
  if (!location) return std::nullopt;
  return ReadPoseFile(*location, options.camera_height_m);
}

// Paths of the posed pictures; all absent ones are reported at once.
std::vector<fs::path> LocatePictures(const PoseFile& poses, const PictureFiles& files) {
  std::vector<fs::path> paths;
  std::vector<std::string> missing;
  std::map<fs::path, std::string> name_of;
  for (const PosedPicture& picture : poses.pictures) {
    paths.push_back(files.Find(picture.name, poses.base));
    if (paths.back().empty()) {
      missing.push_back(picture.name);
      continue;
    }
    const auto [it, is_new] = name_of.emplace(paths.back().lexically_normal(), picture.name);
    if (!is_new) {
      throw InvalidInputError(poses.path.native(),
                              "'" + it->second + "' and '" + picture.name +
                                  "' are the same picture " + paths.back().native(),
                              "keep one pose a picture");
    }
  }
  if (!missing.empty()) {
    throw InvalidInputError(
        poses.path.native(),
        fmt::format("{} of {} pictures that it names are absent: {}", missing.size(),
                    poses.pictures.size(), NameSome(missing)),
        "put them beside it, or into images/ or panos/, or take their poses out");
  }
  return paths;
}

// The camera of a picture of the given size: checks an equirectangular picture's shape and adapts a
// pinhole camera that was given for another resolution.
Camera FitCamera(Camera camera, const ImageSize& size, const fs::path& path) {
  if (camera.model == CameraModel::kEquirectangular) {
    if (std::abs(size.width - 2 * size.height) > 1) {
      throw InvalidInputError(
          path.native(),
          fmt::format("is {} x {} pixels, not twice as wide as high", size.width, size.height),
          "give whole equirectangular panoramas, or a pose file that says pinhole");
    }
    return EquirectangularCamera(size.width, size.height);
  }
  const double scale_x = static_cast<double>(size.width) / camera.width;
  const double scale_y = static_cast<double>(size.height) / camera.height;
  if (std::abs(camera.height * scale_x - size.height) > 1.0) {
    throw InvalidInputError(path.native(),
                            fmt::format("is {} x {} pixels, its camera has {} x {}", size.width,
                                        size.height, camera.width, camera.height),
                            "give the picture that the camera was made for");
  }
  return PinholeCamera(size.width, size.height, camera.fx * scale_x, camera.fy * scale_y,
                       camera.cx * scale_x, camera.cy * scale_y);
}

// "is a part of a panorama of 8192 x 4096 pixels"
std::string DescribeCrop(const PhotoSphere& sphere) {
  return fmt::format("is a part of a panorama of {} x {} pixels, as its XMP metadata tell",
                     sphere.full_size->width, sphere.full_size->height);
}

// What the metadata of an equirectangular picture tell beside its pixels.
void TakeMetadata(View& view) {
  const PhotoSphere sphere = ParsePhotoSphere(ReadXmpPacket(view.path));
  if (sphere.IsCropped({view.camera.width, view.camera.height})) {
    throw InvalidInputError(view.path.native(), DescribeCrop(sphere), "give the whole panorama");
  }
  view.told_up_in_cam = sphere.UpInCam();
}

View MakeView(const PosedPicture& picture, const fs::path& path) {
  View view;
  view.picture = path.filename().native();
  if (!IsValidUtf8(view.picture)) {
    throw InvalidInputError(path.native(), "has a name that is no UTF-8", "rename the picture");
  }
  view.path = path;
  view.sha256 = Sha256OfFile(path);
  view.camera = FitCamera(picture.camera, ReadImageSize(path), path);
  if (view.camera.model == CameraModel::kEquirectangular) TakeMetadata(view);
  view.world_from_cam = picture.world_from_cam;
  view.storey_idx = picture.storey_idx.value_or(0);
  return view;
}

std::vector<View> MakeViews(const PoseFile& poses, const std::vector<fs::path>& paths,
                            RunContext& context) {
  std::vector<View> views(paths.size());
  ParallelFor(context, "read pictures", static_cast<int64_t>(paths.size()), [&](int64_t i) {
    const size_t idx = static_cast<size_t>(i);
    views[idx] = MakeView(poses.pictures[idx], paths[idx]);
  });
  return views;
}

// Order that depends on contents and poses only; the name decides between copies at one place.
std::vector<size_t> OrderByHash(const std::vector<View>& views) {
  std::vector<size_t> order(views.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto key = [&](size_t i) {
    const View& view = views[i];
    const Eigen::Vector3d& t = view.world_from_cam.translation;
    return std::make_tuple(std::cref(view.sha256), t.x(), t.y(), t.z(), std::cref(view.picture));
  };
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return key(a) < key(b); });
  return order;
}

// Fills scene.views with one view a hash, in the order of the hashes. Returns for every posed
// picture the index of its view.
std::vector<int> KeepOneOfEach(const std::vector<View>& all, SceneReadReport& report) {
  std::vector<int> view_of(all.size());
  std::vector<View>& kept = report.scene.views;
  for (const size_t i : OrderByHash(all)) {
    if (kept.empty() || kept.back().sha256 != all[i].sha256) {
      kept.push_back(all[i]);
    } else {
      ++report.num_duplicates;
      const double apart_m =
          (kept.back().world_from_cam.translation - all[i].world_from_cam.translation).norm();
      report.warnings.push_back(fmt::format(
          "{} is the same picture as {}{}; it is left out", all[i].picture, kept.back().picture,
          apart_m > kSamePosition_m ? fmt::format(", though posed {:.2f} m away", apart_m) : ""));
    }
    view_of[i] = static_cast<int>(kept.size()) - 1;
  }
  return view_of;
}

// Pixels of cameras that FitCamera adapted to the size of their picture.
void ScalePixels(const PoseFile& poses, const std::vector<int>& view_of,
                 const std::vector<View>& views, ScenePoint& point) {
  for (size_t k = 0; k < point.pixels.size(); ++k) {
    const auto picture_idx = static_cast<size_t>(point.view_idx[k]);
    const Camera& given = poses.pictures[picture_idx].camera;
    const Camera& fitted = views[static_cast<size_t>(view_of[picture_idx])].camera;
    point.pixels[k].x() *= static_cast<float>(fitted.width) / static_cast<float>(given.width);
    point.pixels[k].y() *= static_cast<float>(fitted.height) / static_cast<float>(given.height);
  }
}

// Views in ascending order, each once: of one that a track names twice the first pixel is kept.
void RenumberViews(const std::vector<int>& view_of, ScenePoint& point) {
  std::vector<std::pair<int, size_t>> order;  // view, place in the track
  for (size_t k = 0; k < point.view_idx.size(); ++k) {
    order.emplace_back(view_of[static_cast<size_t>(point.view_idx[k])], k);
  }
  std::sort(order.begin(), order.end());
  const auto is_same_view = [](const auto& a, const auto& b) { return a.first == b.first; };
  order.erase(std::unique(order.begin(), order.end(), is_same_view), order.end());
  const std::vector<Eigen::Vector2f> pixels = std::exchange(point.pixels, {});
  point.view_idx.clear();
  for (const auto& [view_idx, place] : order) {
    point.view_idx.push_back(view_idx);
    if (!pixels.empty()) point.pixels.push_back(pixels[place]);
  }
}

void TakePoints(const PoseFile& poses, const std::vector<int>& view_of, Scene& scene) {
  scene.points = poses.points;
  for (ScenePoint& point : scene.points) {
    ScalePixels(poses, view_of, scene.views, point);
    RenumberViews(view_of, point);
  }
}

// Storeys where the file tells none: camera heights with a gap between them.
void SplitStoreys(std::vector<View>& views) {
  std::vector<size_t> order(views.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto z = [&](size_t i) { return views[i].world_from_cam.translation.z(); };
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return z(a) < z(b); });
  int storey_idx = 0;
  for (size_t k = 0; k < order.size(); ++k) {
    if (k > 0 && z(order[k]) - z(order[k - 1]) > kStoreyGap_m) ++storey_idx;
    views[order[k]].storey_idx = storey_idx;
  }
}

// The mask of a picture in a folder of masks: same name, same stem as PNG, or name + ".png".
fs::path FindMask(const fs::path& folder, const fs::path& picture) {
  const fs::path name = picture.filename();
  fs::path stem_png = name;
  stem_png.replace_extension(".png");
  for (const fs::path& candidate : {name, stem_png, fs::path(name.native() + ".png")}) {
    std::error_code ignored;
    if (fs::is_regular_file(folder / candidate, ignored)) return folder / candidate;
  }
  return {};
}

void CheckMask(const View& view) {
  const ImageSize size = ReadImageSize(view.mask_path);
  if (size.width != view.camera.width || size.height != view.camera.height) {
    throw InvalidInputError(view.mask_path.native(),
                            fmt::format("is {} x {} pixels, {} is {} x {}", size.width, size.height,
                                        view.picture, view.camera.width, view.camera.height),
                            "give masks of the pictures' size");
  }
}

void AttachMasks(const SceneReadOptions& options, std::vector<View>& views) {
  if (!options.mask.empty()) {
    std::error_code ignored;
    const fs::path mask = options.mask;
    const bool is_folder = fs::is_directory(mask, ignored);
    bool has_any = false;
    for (View& view : views) {
      view.mask_path = is_folder ? FindMask(mask, view.path) : mask;
      has_any = has_any || !view.mask_path.empty();
    }
    if (!has_any) {
      throw InvalidInputError(options.mask, "has no mask with the name of a picture",
                              "name them as the pictures, with .png");
    }
  }
  for (const View& view : views) {
    if (!view.mask_path.empty()) CheckMask(view);
  }
}

// Masks that the pose file names.
void TakeMasks(const PoseFile& poses, const PictureFiles& files, std::vector<View>& views) {
  for (size_t i = 0; i < views.size(); ++i) {
    const std::string& name = poses.pictures[i].mask;
    if (name.empty()) continue;
    views[i].mask_path = files.Find(name, poses.base);
    if (views[i].mask_path.empty()) {
      throw InvalidInputError(poses.path.native(),
                              "the mask '" + name + "' that it names is absent",
                              "put it there or take the name out");
    }
  }
}

void ReportUnposed(const PictureFiles& files, const std::vector<fs::path>& posed,
                   SceneReadReport& report) {
  std::set<fs::path> used;
  for (const fs::path& path : posed) used.insert(path.lexically_normal());
  report.num_pictures_found = static_cast<int>(used.size());
  for (const View& view : report.scene.views) used.insert(view.mask_path.lexically_normal());
  std::vector<std::string> unposed;
  for (const fs::path& path : files.all()) {
    if (!used.contains(path.lexically_normal())) unposed.push_back(PrintablePath(path.filename()));
  }
  report.num_unposed = static_cast<int>(unposed.size());
  report.num_pictures_found += report.num_unposed;
  if (unposed.empty()) return;
  report.warnings.push_back(fmt::format("{} pictures have no pose and are left out: {}",
                                        unposed.size(), NameSome(unposed)));
}

// Why a picture is no whole panorama; empty for one that is.
std::string WhyNoPanorama(const fs::path& path) {
  const ImageSize size = ReadImageSize(path);
  const PhotoSphere sphere = ParsePhotoSphere(ReadXmpPacket(path));
  if (sphere.IsCropped(size)) return DescribeCrop(sphere) + ": give the whole one";
  if (std::abs(size.width - 2 * size.height) <= 1) return {};
  return fmt::format("is {} x {} pixels, not twice as wide as high: no whole panorama", size.width,
                     size.height);
}

// Panoramas without poses. Pictures that are no whole panoramas are left out, as such folders hold
// previews and photographs too.
SceneReadReport ReadPicturesAlone(const fs::path& folder, const PictureFiles& files,
                                  const SceneReadOptions& options, RunContext& context) {
  SceneReadReport report;
  PoseFile none;
  none.source = PoseSource::kEstimated;
  std::vector<fs::path> paths;
  for (const fs::path& path : files.all()) {
    const std::string problem = WhyNoPanorama(path);
    if (!problem.empty()) {
      report.warnings.push_back(
          fmt::format("{} {}; it is left out", PrintablePath(path.filename()), problem));
      continue;
    }
    paths.push_back(path);
    none.pictures.push_back({});
    none.pictures.back().name = path.filename().native();
  }
  report.num_pictures_found = static_cast<int>(files.all().size());
  if (paths.empty()) {
    throw InvalidInputError(folder.native(),
                            files.all().empty() ? "has no pictures" : "has no whole panoramas",
                            "give equirectangular panoramas (.jpg, .png), twice as wide as high; "
                            "photographs and films of one lens need a pose file");
  }
  report.scene.pose_source = PoseSource::kEstimated;
  report.scene.scale_source = ScaleSource::kAssumed;
  if (options.camera_height_m > 0) report.scene.camera_height_m = options.camera_height_m;
  static_cast<void>(KeepOneOfEach(MakeViews(none, paths, context), report));
  AttachMasks(options, report.scene.views);
  return report;
}

SceneReadReport ReadWithPoses(const PictureFiles& files, PoseFile poses,
                              const SceneReadOptions& options, RunContext& context) {
  TurnUpright(poses);
  const std::vector<fs::path> paths = LocatePictures(poses, files);

  SceneReadReport report;
  report.pose_file = poses.path;
  report.warnings = poses.warnings;
  report.scene.pose_source = poses.source;
  report.scene.scale_source = poses.scale_source;
  report.scene.camera_height_m = poses.camera_height_m;
  if (options.camera_height_m > 0) report.scene.camera_height_m = options.camera_height_m;

  std::vector<View> views = MakeViews(poses, paths, context);
  TakeMasks(poses, files, views);
  const std::vector<int> view_of = KeepOneOfEach(views, report);
  TakePoints(poses, view_of, report.scene);
  if (poses.source != PoseSource::kZind) SplitStoreys(report.scene.views);
  AttachMasks(options, report.scene.views);
  ReportUnposed(files, paths, report);
  return report;
}

}  // namespace

SceneReadReport ReadScene(const fs::path& folder, const SceneReadOptions& options,
                          RunContext& context) {
  const PictureFiles files(folder);
  std::optional<PoseFile> poses = FindAndReadPoses(folder, options);
  SceneReadReport report = poses ? ReadWithPoses(files, std::move(*poses), options, context)
                                 : ReadPicturesAlone(folder, files, options, context);
  for (const std::string& warning : report.warnings) context.log().Warning(warning);
  return report;
}

}  // namespace enfilade
