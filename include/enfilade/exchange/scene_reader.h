// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/scene/types.h"

namespace enfilade {

struct SceneReadOptions {
  std::string poses;           ///< file or COLMAP folder; "" = look for one; "none" = no poses
  double camera_height_m = 0;  ///< of the cameras above the floor; 0 = not given
  std::string mask;            ///< picture for all views, or folder with one a view; "" = none

  void Visit(OptionVisitor& v) {
    v("poses", poses,
      "Pose file (transforms.json, poses.csv, zind_data.json) or folder of a COLMAP model; empty: "
      "the first of these found beside the pictures; none: pictures alone.");
    v("camera_height_m", camera_height_m,
      "Height of the cameras above the floor. Sets the scale where poses have none, else is a "
      "prior; 0: not given.",
      {0.0, 100.0});
    v("mask", mask,
      "Grey picture that is 0 where pictures are to be ignored (the camera's stand), or a folder "
      "with such a picture for each view under the same name.");
  }
};

struct SceneReadReport {
  Scene scene;
  std::vector<std::string> warnings;  ///< whole sentences, also written to the log
  std::filesystem::path pose_file;    ///< the file or folder that the poses came from
  int num_pictures_found = 0;         ///< in the folder and where the pose file says
  int num_unposed = 0;                ///< left out because they have no pose
  int num_duplicates = 0;             ///< left out because another file has the same bytes
};

/// Reads a folder of panoramas with known poses (docs/formats.md).
///
/// Pictures (.jpg, .jpeg, .png) are taken from `folder`, `folder/images`, `folder/panos` and from
/// where the pose file says. Poses come from `options.poses`, else from the first that exists of
/// transforms.json, a COLMAP model in `.`, `sparse`, `sparse/0`, poses.csv and zind_data.json.
/// Annotations are never read: of a ZInD tour only positions, yaws, camera heights and scale.
///
/// World: right-handed, metres, z up; the pose file's own where that is z up, else turned so that
/// the cameras stand upright. Of a ZInD tour X = m·gx, Y = −m·gy and Z = 0 on the lowest floor;
/// floors lie 3 m apart, as the tour does not tell. Elsewhere storeys are told apart by gaps of
/// more than 1.8 m between camera heights. All views are in component 0.
///
/// Guarantees: views have distinct hashes, in ascending order; rotations are orthonormal; sizes
/// agree with the files; equirectangular pictures are 2:1; names are UTF-8. Pictures without pose
/// and copies of a picture are left out with a warning. Without any poses, pictures of another
/// shape and those that are parts of a panorama, as their XMP metadata tell, are left out with a
/// warning too; `told_up_in_cam` is what the metadata tell of the vertical.
///
/// Throws IoError when something cannot be opened and InvalidInputError for no pictures, no poses,
/// poses of absent pictures, malformed or non-finite numbers, a matrix that is no rotation, and
/// pictures of the wrong shape. Cost: reads every picture once (hash); decodes none.
[[nodiscard]] SceneReadReport ReadScene(const std::filesystem::path& folder,
                                        const SceneReadOptions& options, RunContext& context);

}  // namespace enfilade
