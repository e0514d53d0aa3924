// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "enfilade/scene/types.h"

namespace enfilade {

/// An image that a dense cloud was made from.
struct CloudImage {
  std::string name;
  /// Of its camera in the cloud's world; unknown where only a list of names is there.
  std::optional<Eigen::Vector3d> position;
};

/// A dense cloud as its file holds it.
struct PointCloud {
  /// In the file's own world; normals unit, or zero where unknown; view_idx counts `images`.
  std::vector<ScenePoint> points;
  bool has_views = false;  ///< the file tells which images see a point
  /// In the order in which the file counts them; empty where nothing tells them.
  std::vector<CloudImage> images;
  std::filesystem::path image_list;  ///< where they come from
};

/// Reads a dense cloud (docs/formats.md), by what the file is called:
///
/// * `.patch`: PMVS2, with the images that see a point;
/// * `.pset`: PMVS2, without them;
/// * anything else is a PLY file. With `FILE.vis` beside it, as COLMAP's stereo_fusion writes it,
///   that tells the images; without, nothing does.
///
/// The images come from `images`: a folder with a COLMAP model (in it, in `sparse` or in
/// `sparse/0`), whose images count in the order of its file, or a text file with a name a line.
/// Empty: such a model beside the PLY file; `bundle.rd.out.list.txt` or `list.txt` beside the
/// patches or in the folder above.
///
/// Guarantees: positions are finite, every view_idx is in `images`, ascending and without
/// repetition. Throws IoError, and InvalidInputError for a file that is broken, without normals or
/// with NaN, a `.vis` of another length, and images out of range or without a list of names.
[[nodiscard]] PointCloud ReadPointCloud(const std::filesystem::path& path,
                                        const std::filesystem::path& images);

/// The files that ReadPointCloud would read, in a fixed order: for telling whether any changed.
/// Throws as it does where one is missing.
[[nodiscard]] std::vector<std::filesystem::path> FilesOfCloud(const std::filesystem::path& path,
                                                              const std::filesystem::path& images);

/// The view of `scene` that every image is of, −1 where there is none. Images are called as the
/// picture or as a part of it that another program made: compared are the last folder and name,
/// then the name, then the name without extension; of images in folders called view_… the names
/// that RenderRigPictures gives come first. A line that fits no picture is tried up to its first
/// blank. A name that fits several pictures fits none.
[[nodiscard]] std::vector<int> ViewsOfImages(std::span<const CloudImage> images,
                                             const Scene& scene);

}  // namespace enfilade
