// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/base/json.h"
#include "enfilade/exchange/scene_reader.h"
#include "enfilade/image/codec.h"
#include "tests/support/temp_folder.h"

namespace enfilade {

/// Writes a small picture of one grey, so that pictures of different `seed` have different hashes.
/// The extension may be any that the reader knows.
inline void WriteTestPicture(const std::filesystem::path& path, int seed, int width = 16,
                             int height = 8) {
  const ImageU8 image(height, width, 3, static_cast<uint8_t>(seed));
  WriteFileAtomic(path, EncodeImage(image, ".png"));
}

inline SceneReadReport ReadTestScene(const std::filesystem::path& folder,
                                     const SceneReadOptions& options = {}) {
  RunContext context(2);
  return ReadScene(folder, options, context);
}

/// The message with which a folder is refused, "" when it is read.
inline std::string SceneRefusal(const std::filesystem::path& folder,
                                const SceneReadOptions& options = {}) {
  try {
    (void)ReadTestScene(folder, options);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

/// A frame of transforms.json: an upright camera at (x, y, z) that looks along +y.
inline nlohmann::json UprightFrame(const std::string& name, double x = 0, double y = 0,
                                   double z = 0) {
  return {{"file_path", name},
          {"transform_matrix", {{1, 0, 0, x}, {0, 0, -1, y}, {0, 1, 0, z}, {0, 0, 0, 1}}}};
}

/// The rotation of UprightFrame in our axes: right +x, down −z, forward +y.
inline Eigen::Matrix3d UprightRotation() {
  Eigen::Matrix3d rotation;
  rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return rotation;
}

inline nlohmann::json EquirectangularTransforms(const std::vector<nlohmann::json>& frames) {
  return {{"camera_model", "EQUIRECTANGULAR"}, {"frames", frames}};
}

/// The view of a picture; fails the test when there is none.
inline const View& ViewOf(const Scene& scene, const std::string& picture) {
  for (const View& view : scene.views) {
    if (view.picture == picture) return view;
  }
  throw std::logic_error("no view of " + picture);
}

/// A folder with the unposed pictures images/a.png and images/b.png.
class PoseFormatTest : public testing::Test {
 protected:
  void SetUp() override {
    WriteTestPicture(folder / "images" / "a.png", 10);
    WriteTestPicture(folder / "images" / "b.png", 20);
  }

  TempFolder temp;
  std::filesystem::path folder = temp.path();
};

}  // namespace enfilade
