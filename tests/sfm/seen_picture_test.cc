// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/seen_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "enfilade/base/file.h"
#include "tests/sfm/random_descriptors.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

SeenPicture MakeSeen(int num_features, int num_segments) {
  SeenPicture seen;
  seen.features.descriptors = RandomValues(num_features, kMaxDescriptorValue, 1);
  for (int i = 0; i < num_features; ++i) {
    const float x = static_cast<float>(i);
    seen.features.rays.emplace_back(std::sin(x), 0.0F, std::cos(x));
    seen.features.sizes_rad.push_back(1 / (1 + x));
    seen.features.walls.push_back(static_cast<uint8_t>(i % 6));
    seen.colours.emplace_back(static_cast<uint8_t>(i), static_cast<uint8_t>(2 * i), uint8_t{7});
  }
  for (int i = 0; i < num_segments; ++i) {
    seen.segments.push_back({Eigen::Vector3d(i, 1, 2), Eigen::Vector3d(3, i, 0.1)});
  }
  return seen;
}

void ExpectSame(const SeenPicture& x, const SeenPicture& y) {
  EXPECT_EQ(x.features.rays, y.features.rays);
  EXPECT_EQ(x.features.sizes_rad, y.features.sizes_rad);
  EXPECT_EQ(x.features.walls, y.features.walls);
  EXPECT_EQ(x.features.descriptors.values, y.features.descriptors.values);
  EXPECT_EQ(x.colours, y.colours);
  EXPECT_EQ(x.floor.contrast.data(), y.floor.contrast.data());
  ASSERT_EQ(x.segments.size(), y.segments.size());
  for (size_t i = 0; i < x.segments.size(); ++i) {
    EXPECT_EQ(x.segments[i].from, y.segments[i].from);
    EXPECT_EQ(x.segments[i].to, y.segments[i].to);
  }
}

class SeenPictureTest : public testing::Test {
 protected:
  static View ViewOf(const std::string& sha256) {
    View view;
    view.sha256 = sha256;
    return view;
  }
  std::string Key() const { return SeenPictureKey(view, trusted, options, program); }

  TempFolder temp;
  View view = ViewOf(std::string(64, 'a'));
  ImageU8 trusted{2, 4};
  FeatureOptions options;
  std::string program = "1.0+abc";
  fs::path file = SeenPictureFile(temp.path() / "features", view);
};

TEST_F(SeenPictureTest, ComesBackAsItWas) {
  for (const auto& [num_features, num_segments] : {std::pair(50, 20), {0, 3}, {2, 0}, {0, 0}}) {
    const SeenPicture seen = MakeSeen(num_features, num_segments);
    SaveSeenPicture(file, Key(), seen);
    const std::optional<SeenPicture> loaded = LoadSeenPicture(file, Key());
    ASSERT_TRUE(loaded.has_value());
    ExpectSame(*loaded, seen);
  }
}

TEST_F(SeenPictureTest, BringsTheFloorBack) {
  SeenPicture seen = MakeSeen(3, 2);
  seen.floor.contrast = {FloorPicture::kSide, FloorPicture::kSide, 1, int8_t{-3}};
  seen.floor.contrast(5, 7) = 90;
  SaveSeenPicture(file, Key(), seen);
  const std::optional<SeenPicture> loaded = LoadSeenPicture(file, Key());
  ASSERT_TRUE(loaded.has_value());
  ExpectSame(*loaded, seen);
  EXPECT_EQ(loaded->floor.contrast.rows(), FloorPicture::kSide);
}

TEST_F(SeenPictureTest, IsAbsentAtFirst) { EXPECT_FALSE(LoadSeenPicture(file, Key())); }

TEST_F(SeenPictureTest, WhatIsNoFileIsIgnored) {
  fs::create_directories(file);
  EXPECT_FALSE(LoadSeenPicture(file, Key()));
}

// Wherever a file is cut or a byte of it is another one.
TEST_F(SeenPictureTest, DamagedFilesAreIgnored) {
  SaveSeenPicture(file, Key(), MakeSeen(2, 1));
  const std::string whole = ReadFile(file);
  for (size_t i = 0; i < whole.size(); ++i) {
    std::string bytes = whole.substr(0, i);
    WriteFileAtomic(file, bytes);
    ASSERT_FALSE(LoadSeenPicture(file, Key())) << "cut at " << i;
    bytes = whole;
    bytes[i] = static_cast<char>(bytes[i] ^ 4);
    WriteFileAtomic(file, bytes);
    ASSERT_FALSE(LoadSeenPicture(file, Key())) << "wrong at " << i;
  }
  WriteFileAtomic(file, whole + "x");
  EXPECT_FALSE(LoadSeenPicture(file, Key()));
  WriteFileAtomic(file, whole);
  EXPECT_TRUE(LoadSeenPicture(file, Key()));
}

TEST_F(SeenPictureTest, OtherKeysAreIgnored) {
  SaveSeenPicture(file, Key(), MakeSeen(2, 1));
  const std::string key = Key();
  view.sha256.back() = 'b';  // the name of the file is still the same
  EXPECT_EQ(SeenPictureFile(temp.path() / "features", view), file);
  EXPECT_FALSE(LoadSeenPicture(file, Key()));
  view.sha256.back() = 'a';
  options.max_features = 100;
  EXPECT_FALSE(LoadSeenPicture(file, Key()));
  options = {};
  options.min_contrast = 0.01;
  EXPECT_FALSE(LoadSeenPicture(file, Key()));
  options = {};
  trusted.row(1)[2] = 255;
  EXPECT_FALSE(LoadSeenPicture(file, Key()));
  trusted.row(1)[2] = 0;
  program = "1.0+abd";
  EXPECT_FALSE(LoadSeenPicture(file, Key()));
  program = "1.0+abc";
  EXPECT_EQ(Key(), key);
  EXPECT_TRUE(LoadSeenPicture(file, Key()));
}

}  // namespace
}  // namespace enfilade
