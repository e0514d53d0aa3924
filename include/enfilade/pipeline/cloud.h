// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/scene/types.h"

namespace enfilade {

/// The axis of a cloud's file that points up.
enum class CloudUp { kPoses, kX, kMinusX, kY, kMinusY, kZ, kMinusZ };
[[nodiscard]] std::span<const std::string_view> EnumNames(CloudUp);

struct CloudOptions {
  std::string file;              ///< .patch, .pset or PLY; "" = none
  std::string images;            ///< list of the images that the file counts; "" = look for one
  CloudUp up = CloudUp::kPoses;  ///< kPoses: the axes are those of the poses
  double scale = 1;              ///< metres, or units of the poses, in a unit of the cloud

  void Visit(OptionVisitor& v) {
    v("file", file,
      "Dense cloud in the world of the poses: PLY (with FILE.vis beside it, as COLMAP's "
      "stereo_fusion writes it, or with normals alone), PMVS2's .patch or .pset; empty: none.");
    v("images", images,
      "The images that the cloud counts: folder of a COLMAP model, or text file with a picture's "
      "name a line; empty: where COLMAP and PMVS2 put them.");
    v("up", up, "Axis of the cloud that points up, where its axes are not those of the poses.");
    v("scale", scale, "Length of the cloud's unit in the unit of the poses.", {1e-6, 1e6});
  }
};

/// Reads the dense cloud and brings it into the world of the scene: turned, scaled, view_idx those
/// of the scene's views, points that no view sees left out. Where the file does not tell who sees a
/// point, rays are cast against the cloud itself (FindViewsOfPoints); the log says so in one line.
///
/// Where a COLMAP model tells the positions of the cloud's images, and those of three or more views
/// span a triangle, the similarity that takes them to the views' (Umeyama 1991) is what brings the
/// cloud into the scene's world, whatever its axes and unit; positions that do not agree within
/// 5 % of their spread are refused. Else the cloud's world must be the scene's, but for
/// CloudOptions::up and scale.
///
/// Throws InvalidInputError, besides what ReadPointCloud throws, for fewer than 100 points, and for
/// a cloud that the cameras do not fit into: they stand outside it, it is far larger than their
/// spread, they are not above its floor, or its normals do not look at those that see it. The cure
/// names the axis or the unit with which they would.
[[nodiscard]] std::vector<ScenePoint> ReadCloud(const CloudOptions& options, const Scene& scene,
                                                RunContext& context);

/// The cloud between the stages: exactly the points that were written, but for their pixels.
/// WriteCloudFile throws IoError; ReadCloudFile also InvalidInputError for a file that is cut, too
/// long, of another format or version, not finite, or names views that are not among `num_views`.
void WriteCloudFile(const std::filesystem::path& path, std::span<const ScenePoint> points);
[[nodiscard]] std::vector<ScenePoint> ReadCloudFile(const std::filesystem::path& path,
                                                    size_t num_views);

}  // namespace enfilade
