// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/label_file.h"

#include <gtest/gtest.h>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/image/codec.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

LabelMaps ExampleMaps() {
  LabelMaps maps{ImageU8(8, 16), ImageU8(8, 16), ImageU8(8, 16, 1, 2)};
  maps.after_free_space(7, 3) = 1;
  maps.final_labels(7, 3) = 1;
  maps.final_labels(0, 9) = 3;
  return maps;
}

TEST(LabelFile, ReadsExactlyWhatItWrites) {
  const TempFolder folder;
  EXPECT_FALSE(ReadLabelMaps(folder.path(), 4));
  WriteLabelMaps(folder.path(), 4, ExampleMaps());
  const auto maps = ReadLabelMaps(folder.path(), 4);
  ASSERT_TRUE(maps);
  EXPECT_EQ(maps->after_points.data(), ExampleMaps().after_points.data());
  EXPECT_EQ(maps->after_free_space.data(), ExampleMaps().after_free_space.data());
  EXPECT_EQ(maps->final_labels.data(), ExampleMaps().final_labels.data());
  EXPECT_FALSE(ReadLabelMaps(folder.path(), 5));
}

TEST(LabelFile, RefusesWhatIsNoLabelMap) {
  const TempFolder folder;
  WriteLabelMaps(folder.path(), 0, ExampleMaps());
  const auto file = folder.path() / "labels_0000_free_space.png";
  WriteImage(file, ImageU8(4, 8));
  EXPECT_THROW((void)ReadLabelMaps(folder.path(), 0), InvalidInputError);
  WriteImage(file, ImageU8(8, 16, 1, 4));
  EXPECT_THROW((void)ReadLabelMaps(folder.path(), 0), InvalidInputError);
  WriteFileAtomic(file, "no picture");
  EXPECT_THROW((void)ReadLabelMaps(folder.path(), 0), InvalidInputError);
  std::filesystem::remove(file);
  EXPECT_ANY_THROW((void)ReadLabelMaps(folder.path(), 0));
}

TEST(LabelFile, PictureShowsThePanoramaTintedThreeTimes) {
  const TempFolder folder;
  WriteLabelPicture(folder.path(), 0, ExampleMaps(), ImageU8(16, 32, 3, 100));
  const ImageU8 sheet = ReadImageRgb(folder.path() / "labels_0000.jpg");
  EXPECT_EQ(sheet.rows(), 24);
  EXPECT_EQ(sheet.cols(), 16);
  EXPECT_NEAR(sheet(3, 3, 0), 100, 4);   // not known yet
  EXPECT_NEAR(sheet(19, 3, 0), 150, 8);  // wall
  EXPECT_GT(sheet(19, 3, 0), sheet(19, 3, 2));
}

}  // namespace
}  // namespace enfilade
