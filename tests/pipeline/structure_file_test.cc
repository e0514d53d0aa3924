// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/structure_file.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/geometry/angles.h"
#include "tests/pipeline/damage.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

Structure ExampleStructure() {
  std::mt19937 random(3);
  Structure structure;
  structure.home_from_world = {RotationZ(0.3), {0, 0, 0}};
  structure.heading_rad = -0.3;
  structure.storeys = {{0.1, 2.6, 0.08}, {2.9, 5.4, 0}};
  structure.bin_m = {0.5, 0.7, 1.0 / 3.0 + 1};
  for (int i = 0; i < 2; ++i) {
    WallProfile profile;
    profile.view_idx = i;
    profile.floor_z = 0.1 * i;
    profile.ceiling_z = 2.5 + 0.1 * i;
    profile.ceiling_weight = 0.75;
    profile.wall_m = RandomFloats(8, random);
    profile.obstacle_m = RandomFloats(8, random);
    profile.confidence = RandomFloats(8, random);
    profile.is_seen = {1, 1, 0, 1, 1, 1, 0, 1};
    profile.wall_probability = ImageF(8, 3);
    profile.wall_probability.data() = RandomFloats(24, random);
    structure.profiles.push_back(profile);
  }
  return structure;
}

TEST(StructureFile, ReadsExactlyWhatItWrites) {
  const TempFolder folder;
  const Structure written = ExampleStructure();
  WriteStructure(folder.path(), written);
  const Structure read = ReadStructure(folder.path());
  EXPECT_EQ(read.home_from_world.rotation, written.home_from_world.rotation);
  EXPECT_EQ(read.home_from_world.translation, written.home_from_world.translation);
  EXPECT_EQ(read.heading_rad, written.heading_rad);
  EXPECT_EQ(read.bin_m, written.bin_m);
  ASSERT_EQ(read.storeys.size(), 2u);
  EXPECT_EQ(read.storeys[1].floor_z, 2.9);
  EXPECT_EQ(read.storeys[1].ceiling_z, 5.4);
  EXPECT_EQ(read.storeys[0].baseboard_m, 0.08);
  ASSERT_EQ(read.profiles.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    const WallProfile &a = read.profiles[i], &b = written.profiles[i];
    EXPECT_EQ(a.view_idx, b.view_idx);
    EXPECT_EQ(a.floor_z, b.floor_z);
    EXPECT_EQ(a.ceiling_z, b.ceiling_z);
    EXPECT_EQ(a.ceiling_weight, b.ceiling_weight);
    EXPECT_EQ(a.wall_m, b.wall_m);
    EXPECT_EQ(a.obstacle_m, b.obstacle_m);
    EXPECT_EQ(a.confidence, b.confidence);
    EXPECT_EQ(a.is_seen, b.is_seen);
    EXPECT_EQ(a.wall_probability.rows(), 8);
    EXPECT_EQ(a.wall_probability.data(), b.wall_probability.data());
  }
}

TEST(StructureFile, RefusesDamage) {
  const TempFolder folder;
  WriteStructure(folder.path(), ExampleStructure());
  const auto read = [&] { (void)ReadStructure(folder.path()); };
  ExpectRefusesDamage(folder / "structure.json", read);
  ExpectRefusesDamage(folder / "profile_0001.bin", read);
}

TEST(StructureFile, RefusesHugeSizesAndNan) {
  constexpr size_t kSizesAt = 12, kArraysAt = 20;
  const int32_t huge = std::numeric_limits<int32_t>::max(), negative = -1, many = 1 << 20;
  const float nan = std::nanf("");
  for (const int32_t size : {huge, negative, many}) {
    const TempFolder folder;
    WriteStructure(folder.path(), ExampleStructure());
    Poke(folder / "profile_0000.bin", kSizesAt, &size, sizeof size);
    EXPECT_THROW((void)ReadStructure(folder.path()), InvalidInputError) << size;
  }
  const TempFolder folder;
  WriteStructure(folder.path(), ExampleStructure());
  Poke(folder / "profile_0000.bin", kArraysAt, &nan, sizeof nan);
  EXPECT_THROW((void)ReadStructure(folder.path()), InvalidInputError);
}

}  // namespace
}  // namespace enfilade
