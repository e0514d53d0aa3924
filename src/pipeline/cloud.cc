// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/cloud.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <system_error>

#include "enfilade/base/errors.h"
#include "enfilade/exchange/point_cloud_reader.h"
#include "enfilade/pipeline/memory_need.h"
#include "enfilade/scene/point_views.h"
#include "src/pipeline/cloud_fit.h"

namespace enfilade {
namespace {

using Eigen::Affine3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr size_t kMinPoints = 100;

// The rotation that makes an axis of the cloud point up.
Matrix3d TurnUp(CloudUp up) {
  if (up == CloudUp::kPoses) return Matrix3d::Identity();
  const int number = static_cast<int>(up) - 1;
  const Vector3d axis = (number % 2 == 0 ? 1.0 : -1.0) * Vector3d::Unit(number / 2);
  // Half a turn for −z, about x: FromTwoVectors would choose its axis by rounding.
  if (up == CloudUp::kMinusZ) return Vector3d(1, -1, -1).asDiagonal();
  return Eigen::Quaterniond::FromTwoVectors(axis, Vector3d::UnitZ()).toRotationMatrix();
}

Affine3d Turned(CloudUp up, double scale) { return Affine3d(Matrix3d(scale * TurnUp(up))); }

// The options that would make the cloud fit; empty for none.
std::string FindCure(const CloudFit& fit, const CloudOptions& options) {
  constexpr std::array<CloudUp, 7> kUps = {CloudUp::kPoses, CloudUp::kY, CloudUp::kMinusY,
                                           CloudUp::kZ,     CloudUp::kX, CloudUp::kMinusX,
                                           CloudUp::kMinusZ};
  constexpr std::array<double, 6> kScales = {1, 0.001, 0.01, 0.0254, 0.3048, 1000};
  for (const double scale : kScales) {
    for (const CloudUp up : kUps) {
      if (!fit.Problem(Turned(up, scale)).empty()) continue;
      std::string cure;
      if (up != options.up)
        cure += fmt::format(" --points-up {}", EnumNames(up)[static_cast<size_t>(up)]);
      if (scale != options.scale) cure += fmt::format(" --points-scale {:g}", scale);
      return cure;
    }
  }
  return "";
}

// Where the positions of views are known in both worlds.
struct Matched {
  Eigen::Matrix3Xd in_cloud;
  Eigen::Matrix3Xd in_scene;
};

// One a view: several images may be parts of one panorama.
Matched MatchPositions(const PointCloud& cloud, std::span<const int> view_of, const Scene& scene) {
  std::vector<std::optional<Vector3d>> in_cloud(scene.views.size());
  for (size_t i = 0; i < cloud.images.size(); ++i) {
    if (view_of[i] >= 0) in_cloud[static_cast<size_t>(view_of[i])] = cloud.images[i].position;
  }
  const auto count = std::count_if(in_cloud.begin(), in_cloud.end(),
                                   [](const auto& position) { return position.has_value(); });
  Matched matched{Eigen::Matrix3Xd(3, count), Eigen::Matrix3Xd(3, count)};
  Eigen::Index column = 0;
  for (size_t i = 0; i < in_cloud.size(); ++i) {
    if (!in_cloud[i]) continue;
    matched.in_cloud.col(column) = *in_cloud[i];
    matched.in_scene.col(column++) = scene.views[i].world_from_cam.translation;
  }
  return matched;
}

// Standard deviations of points along their three main axes, the largest first.
Vector3d Spread(const Eigen::Matrix3Xd& points) {
  const Eigen::Matrix3Xd centred = points.colwise() - points.rowwise().mean();
  const Matrix3d covariance = centred * centred.transpose() / static_cast<double>(points.cols());
  return covariance.jacobiSvd().singularValues().cwiseSqrt();
}

// The similarity that the cameras tell; none where they are too few or stand in line.
std::optional<Affine3d> AlignCameras(const PointCloud& cloud, std::span<const int> view_of,
                                     const Scene& scene, const CloudOptions& options,
                                     RunContext& context) {
  constexpr double kMinSpread_m = 0.1, kMaxError = 0.05;
  constexpr double kSame_m = 1e-3;  // it is the scene's world, and stays so to the last bit
  const Matched matched = MatchPositions(cloud, view_of, scene);
  if (matched.in_scene.cols() < 3) return std::nullopt;
  const Vector3d spread = Spread(matched.in_scene);
  const auto rms_m = [](const Eigen::Matrix3Xd& errors) {
    return std::sqrt(errors.colwise().squaredNorm().mean());
  };
  if (rms_m(matched.in_cloud - matched.in_scene) < kSame_m) return Affine3d::Identity();
  if (spread[1] < kMinSpread_m || !(Spread(matched.in_cloud)[1] > 0)) return std::nullopt;
  const Affine3d world_from_cloud(Eigen::umeyama(matched.in_cloud, matched.in_scene));
  const double error_m = rms_m(world_from_cloud * matched.in_cloud - matched.in_scene);
  if (!(error_m <= kMaxError * spread[0])) {
    throw InvalidInputError(
        options.file,
        fmt::format("is of other poses: its cameras, {}, are {:.2g} m off on the average",
                    PrintablePath(cloud.image_list), error_m),
        "give the cloud that was made with these poses");
  }
  const double scale = std::cbrt(world_from_cloud.linear().determinant());
  context.log().Info(
      fmt::format("{}: is brought into the world of the poses by the positions of {} cameras, "
                  "which agree within {:.2g} m; its unit is {:.4g} m",
                  PrintablePath(options.file), matched.in_scene.cols(), error_m, scale));
  return world_from_cloud;
}

// A file is read whole and its points take about four times as much.
void RequireMemoryFor(const CloudOptions& options, RunContext& context) {
  constexpr double kBase_mb = 90, kFactor = 5;
  std::error_code ignored;
  const auto size = std::filesystem::file_size(options.file, ignored);
  if (!ignored) {
    RequireMemory(kBase_mb + 1e-6 * kFactor * static_cast<double>(size),
                  "allow more, or thin the cloud out, for example with CloudCompare", context);
  }
}

void RequireEnough(const CloudOptions& options, size_t num_points, const std::string& which) {
  if (num_points >= kMinPoints) return;
  throw InvalidInputError(
      options.file,
      fmt::format("has {} points{}, too few: {} are needed", num_points, which, kMinPoints),
      "give a dense cloud of these pictures");
}

// The views of the images that the cloud counts.
std::vector<int> FindViews(const PointCloud& cloud, const Scene& scene, RunContext& context) {
  std::vector<int> view_of = ViewsOfImages(cloud.images, scene);
  const auto num_unknown = std::count(view_of.begin(), view_of.end(), -1);
  if (num_unknown == 0) return view_of;
  const auto first = std::find(view_of.begin(), view_of.end(), -1) - view_of.begin();
  const std::string& name = cloud.images[static_cast<size_t>(first)].name;
  if (num_unknown == static_cast<std::ptrdiff_t>(view_of.size())) {
    throw InvalidInputError(cloud.image_list.native(),
                            "names no picture of this scene; the first is '" + name + "'",
                            "give the list of the cloud's images, called as the pictures, with "
                            "--points-images");
  }
  context.log().Warning(
      fmt::format("{}: {} of {} images are no pictures of this scene, such as '{}'; what they see "
                  "is left out",
                  PrintablePath(cloud.image_list), num_unknown, view_of.size(), name));
  return view_of;
}

Affine3d PlaceCloud(const PointCloud& cloud, std::span<const int> view_of, const Scene& scene,
                    const CloudOptions& options, RunContext& context) {
  const CloudFit fit(cloud, view_of, scene.views);
  const std::optional<Affine3d> aligned = AlignCameras(cloud, view_of, scene, options, context);
  if (aligned && (options.up != CloudUp::kPoses || options.scale != 1)) {
    context.log().Warning("--points-up and --points-scale are not used: " +
                          PrintablePath(cloud.image_list) + " tells the cloud's world");
  }
  const Affine3d world_from_cloud = aligned.value_or(Turned(options.up, options.scale));
  const std::string problem = fit.Problem(world_from_cloud);
  if (problem.empty()) return world_from_cloud;
  const std::string cure = aligned ? "" : FindCure(fit, options);
  throw InvalidInputError(options.file, "is not in the world of the poses: " + problem,
                          cure.empty() ? "give the cloud that was made with these poses"
                                       : "they would fit with" + cure);
}

void BringToScene(const Affine3d& world_from_cloud, std::span<const int> view_of,
                  std::vector<ScenePoint>& points) {
  for (ScenePoint& point : points) {
    point.position = world_from_cloud * point.position;
    if (!point.normal.isZero(0))
      point.normal = (world_from_cloud.linear() * point.normal).normalized();
    for (int& image : point.view_idx) image = view_of[static_cast<size_t>(image)];
    std::sort(point.view_idx.begin(), point.view_idx.end());
    const auto end = std::unique(point.view_idx.begin(), point.view_idx.end());
    point.view_idx.erase(end, point.view_idx.end());
    if (!point.view_idx.empty() && point.view_idx.front() < 0)
      point.view_idx.erase(point.view_idx.begin());
  }
}

}  // namespace

std::span<const std::string_view> EnumNames(CloudUp) {
  static constexpr std::array<std::string_view, 7> kNames = {"poses",   "x", "minus_x", "y",
                                                             "minus_y", "z", "minus_z"};
  return kNames;
}

std::vector<ScenePoint> ReadCloud(const CloudOptions& options, const Scene& scene,
                                  RunContext& context) {
  RequireMemoryFor(options, context);
  PointCloud cloud = ReadPointCloud(options.file, options.images);
  const size_t num_read = cloud.points.size();
  RequireEnough(options, num_read, "");
  const std::vector<int> view_of = FindViews(cloud, scene, context);
  BringToScene(PlaceCloud(cloud, view_of, scene, options, context), view_of, cloud.points);
  if (!cloud.has_views) {
    context.log().Info(PrintablePath(options.file) +
                       ": does not tell who sees its points; rays cast against the cloud itself "
                       "tell it");
    FindViewsOfPoints(scene.views, cloud.points, context);
  }
  std::erase_if(cloud.points, [](const ScenePoint& point) { return point.view_idx.empty(); });
  RequireEnough(options, cloud.points.size(), " that a picture sees");
  context.log().Info(fmt::format("{}: {} points, {} of them seen by pictures",
                                 PrintablePath(options.file), num_read, cloud.points.size()));
  return std::move(cloud.points);
}

}  // namespace enfilade
