// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "enfilade/geometry/rigid3.h"
#include "enfilade/scene/camera.h"
#include "enfilade/scene/types.h"

namespace enfilade {

/// One picture as a pose file describes it, before the picture is looked up.
struct PosedPicture {
  std::string name;  ///< as the file writes it, may hold folders
  std::string mask;  ///< likewise, often empty
  Rigid3 world_from_cam;
  Camera camera;  ///< width and height are 0 where the file does not tell
  std::optional<int> storey_idx;
};

/// What every pose format is read into.
struct PoseFile {
  std::filesystem::path path;  ///< the file or folder, for messages
  std::filesystem::path base;  ///< the folder that names are relative to
  PoseSource source = PoseSource::kTransforms;
  ScaleSource scale_source = ScaleSource::kPoses;
  std::optional<double> camera_height_m;
  std::vector<PosedPicture> pictures;
  std::vector<ScenePoint> points;  ///< view_idx counts `pictures`
  std::vector<std::string> warnings;
};

/// Where poses come from: found by FindPoses or named by the user.
struct PoseLocation {
  PoseSource source;
  std::filesystem::path path;  ///< file, or folder of a COLMAP model
};

/// The first pose source in `folder` in the order of docs/formats.md, none when there is none.
[[nodiscard]] std::optional<PoseLocation> FindPoses(const std::filesystem::path& folder);

/// What the user's --poses names, told by kind and content. Throws InvalidInputError, IoError.
[[nodiscard]] PoseLocation LocatePoses(const std::filesystem::path& path);

/// Reads any source and checks what all have in common: at least one picture, finite positions
/// within 10 km of each other, no name twice.
[[nodiscard]] PoseFile ReadPoseFile(const PoseLocation& location, double camera_height_m);

/// True when cameras and images of a COLMAP model lie in the folder, binary or text.
[[nodiscard]] bool HasColmapModel(const std::filesystem::path& folder);

// The formats.
[[nodiscard]] PoseFile ReadTransforms(const std::filesystem::path& path);
[[nodiscard]] PoseFile ReadColmapModel(const std::filesystem::path& folder);
[[nodiscard]] PoseFile ReadPoseCsv(const std::filesystem::path& path);
[[nodiscard]] PoseFile ReadZindPoses(const std::filesystem::path& path, double camera_height_m);

/// Turns a world whose cameras do not stand upright so that z points up, with a warning.
void TurnUpright(PoseFile& poses);

/// Scales poses without unit to metres so that the cameras stand `camera_height_m` above the floor
/// that the model's points show; without enough points, or without a height (0), the unit is taken
/// as metres, with a warning.
void ScaleToMetres(PoseFile& poses, double camera_height_m);

}  // namespace enfilade
