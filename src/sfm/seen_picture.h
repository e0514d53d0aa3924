// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "enfilade/image/image.h"
#include "enfilade/scene/types.h"
#include "enfilade/sfm/features.h"
#include "enfilade/sfm/gravity.h"
#include "enfilade/sfm/types.h"
#include "src/sfm/floor_picture.h"

namespace enfilade {

/// What is kept of a panorama once it was looked at.
struct SeenPicture {
  PanoFeatures features;
  std::vector<Eigen::Matrix<uint8_t, 3, 1>> colours;  ///< RGB, one a feature
  std::vector<LineSegment> segments;
  FloorPicture floor;
};

/// The file in `folder` in which PlacePanoramas leaves what it saw of a panorama, so that a stopped
/// run goes on where it was: one file a picture, named after its hash.
[[nodiscard]] std::filesystem::path SeenPictureFile(const std::filesystem::path& folder,
                                                    const View& view);

/// A hash of all that decides what is seen: the picture, its trusted pixels, the options of
/// ExtractFeatures, and the program, which may look otherwise in its next version.
[[nodiscard]] std::string SeenPictureKey(const View& view, const ImageU8& trusted,
                                         const FeatureOptions& options, std::string_view program);

/// What SaveSeenPicture wrote under this key; none when the file is absent, unreadable, damaged or
/// was written under another key.
[[nodiscard]] std::optional<SeenPicture> LoadSeenPicture(const std::filesystem::path& file,
                                                         std::string_view key);

/// Replaces the file as a whole. Throws IoError.
void SaveSeenPicture(const std::filesystem::path& file, std::string_view key,
                     const SeenPicture& seen);

}  // namespace enfilade
