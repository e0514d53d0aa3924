// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/point_cloud_reader.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "enfilade/base/errors.h"
#include "src/exchange/byte_file.h"
#include "src/exchange/cloud_images.h"
#include "src/exchange/patch_reader.h"
#include "src/exchange/ply_points.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

// Who sees each point, as COLMAP's stereo_fusion writes it: a count of points, then for each a
// count of images and their numbers.
void ReadVisibility(const fs::path& path, std::vector<ScenePoint>& points) {
  ByteFile file(path, "the .vis file of this cloud");
  const auto count = file.Take<uint64_t>();
  if (count != points.size()) {
    throw InvalidInputError(path.native(),
                            "is of " + std::to_string(count) + " points, the cloud has " +
                                std::to_string(points.size()),
                            "give the two files that one run of stereo_fusion wrote");
  }
  for (ScenePoint& point : points) {
    point.view_idx.resize(file.TakeCount<uint32_t>(sizeof(uint32_t)));
    for (int& image : point.view_idx) image = file.Take<int32_t>();
  }
  file.ExpectEnd();
}

// Of a file that counts its images: in range, each once and in ascending order.
void TidyImages(const std::string& where, PointCloud& cloud) {
  const auto num_images = static_cast<int>(cloud.images.size());
  for (size_t i = 0; i < cloud.points.size(); ++i) {
    std::vector<int>& images = cloud.points[i].view_idx;
    std::sort(images.begin(), images.end());
    images.erase(std::unique(images.begin(), images.end()), images.end());
    if (images.empty() || (images.front() >= 0 && images.back() < num_images)) continue;
    const int wrong = images.front() < 0 ? images.front() : images.back();
    throw InvalidInputError(
        where,
        "point " + std::to_string(i) + " (from 0) is seen by image " + std::to_string(wrong) +
            ", but " + PrintablePath(cloud.image_list) + " has " + std::to_string(num_images),
        "give the list of the images that the cloud was made from with --points-images");
  }
}

enum class CloudKind { kPly, kPatch, kPset };

struct CloudFiles {
  CloudKind kind = CloudKind::kPly;
  fs::path beside;  // .vis of a PLY file, PLY file with the colours of patches; empty for none
  bool counts_images = false;
  fs::path image_list;  // empty for none
};

CloudFiles FindFiles(const fs::path& path, const fs::path& images) {
  CloudFiles files;
  files.image_list = images;
  std::error_code ignored;
  if (path.extension() == ".pset") {
    files.kind = CloudKind::kPset;
  } else if (path.extension() == ".patch") {
    files.kind = CloudKind::kPatch;
    fs::path colours = path;
    colours.replace_extension(".ply");
    if (fs::exists(colours, ignored)) files.beside = colours;
    files.counts_images = true;
    if (images.empty()) files.image_list = FindPmvsImages(path);
  } else if (const fs::path vis = path.native() + ".vis"; fs::exists(vis, ignored)) {
    files.beside = vis;
    files.counts_images = true;
    if (images.empty()) files.image_list = FindColmapImages(path);
  }
  return files;
}

}  // namespace

PointCloud ReadPointCloud(const fs::path& path, const fs::path& images) {
  const CloudFiles files = FindFiles(path, images);
  PointCloud cloud;
  cloud.image_list = files.image_list;
  cloud.has_views = files.counts_images;
  if (files.kind == CloudKind::kPatch) {
    cloud.points = ReadPatches(path, files.beside);
  } else if (files.kind == CloudKind::kPset) {
    cloud.points = ReadPset(path);
  } else {
    cloud.points = ReadPlyPoints(path);
    if (cloud.has_views) ReadVisibility(files.beside, cloud.points);
  }
  if (!cloud.image_list.empty()) cloud.images = ReadCloudImages(cloud.image_list);
  const bool is_in_vis = files.kind == CloudKind::kPly;
  if (cloud.has_views) TidyImages(is_in_vis ? files.beside.native() : path.native(), cloud);
  return cloud;
}

std::vector<fs::path> FilesOfCloud(const fs::path& path, const fs::path& images) {
  const CloudFiles files = FindFiles(path, images);
  std::vector<fs::path> all = {path};
  if (!files.beside.empty()) all.push_back(files.beside);
  if (!files.image_list.empty()) all.push_back(FileOfImages(files.image_list));
  return all;
}

}  // namespace enfilade
