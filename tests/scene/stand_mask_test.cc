// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/scene/stand_mask.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "enfilade/base/errors.h"
#include "enfilade/image/codec.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

constexpr int kRows = 256, kCols = 512;

// Blobs of random size and grey: a floor with things on it, different for each seed.
ImageU8 Floor(uint32_t seed, int channels = 3) {
  std::mt19937 random(seed);
  ImageU8 image(kRows, kCols, channels, static_cast<uint8_t>(100 + random() % 60));
  for (int i = 0; i < 400; ++i) {
    const int row = static_cast<int>(random() % kRows), col = static_cast<int>(random() % kCols);
    const int height = 5 + static_cast<int>(random() % 60),
              width = 5 + static_cast<int>(random() % 90);
    const uint8_t grey = static_cast<uint8_t>(random() % 256);
    for (int r = row; r < std::min(kRows, row + height); ++r) {
      for (int c = col; c < col + width; ++c) {
        for (int k = 0; k < channels; ++k) image(r, c % kCols, k) = grey;
      }
    }
  }
  return image;
}

ImageU8 UniformFloor(uint32_t seed) {
  std::mt19937 random(seed);
  ImageU8 image(kRows, kCols, 3, 128);
  for (uint8_t& value : image.data()) value = static_cast<uint8_t>(value + random() % 9);
  return image;
}

// A dark disc with a bright ring below `share` of the rows, three legs above it.
void AddStand(ImageU8& image, double share) {
  const int top = static_cast<int>(std::lround((1 - share) * kRows));
  for (int r = top; r < kRows; ++r) {
    for (int c = 0; c < kCols; ++c) {
      const uint8_t grey = r < top + 4 || (c / 32) % 4 == 0 ? 60 : 20;
      for (int k = 0; k < image.channels(); ++k) image(r, c, k) = grey;
    }
  }
}

std::vector<ImageU8> Capture(int num_pictures, double stand_share) {
  std::vector<ImageU8> panoramas;
  for (int i = 0; i < num_pictures; ++i) {
    panoramas.push_back(Floor(static_cast<uint32_t>(i)));
    if (stand_share > 0) AddStand(panoramas.back(), stand_share);
  }
  return panoramas;
}

TEST(FindStand, FindsTheBodyWithinThreeRowsOf256) {
  StandOptions options;
  options.margin_share = 0;
  for (const int num_pictures : {3, 5, 12}) {
    for (const double share : {0.03, 0.06, 0.10, 0.14}) {
      const Stand stand = FindStand(Capture(num_pictures, share), options);
      EXPECT_TRUE(stand.is_measured) << num_pictures << " " << share;
      EXPECT_NEAR(stand.masked_share, share, 3.0 / 256) << num_pictures;
    }
  }
}

TEST(FindStand, AddsTheMarginForLegs) {
  StandOptions options;
  options.margin_share = 0;
  const auto panoramas = Capture(6, 0.06);
  const double body = FindStand(panoramas, options).masked_share;
  options.margin_share = 0.04;
  EXPECT_NEAR(FindStand(panoramas, options).masked_share, body + 0.04, 1e-12);
}

TEST(FindStand, FloorsWithoutStandGiveTheDefault) {
  for (const int num_pictures : {3, 4, 8}) {
    const Stand stand = FindStand(Capture(num_pictures, 0), {});
    EXPECT_FALSE(stand.is_measured) << num_pictures;
    EXPECT_EQ(stand.masked_share, 0.10);
  }
}

TEST(FindStand, UniformCarpetIsNoStand) {
  std::vector<ImageU8> panoramas;
  for (uint32_t i = 0; i < 6; ++i) panoramas.push_back(UniformFloor(i));
  EXPECT_FALSE(FindStand(panoramas, {}).is_measured);
  const std::vector<ImageU8> constant(5, ImageU8(kRows, kCols, 3, 90));
  EXPECT_FALSE(FindStand(constant, {}).is_measured);
}

TEST(FindStand, UniformCarpetDoesNotHideTheStand) {
  std::vector<ImageU8> panoramas;
  for (uint32_t i = 0; i < 6; ++i) {
    panoramas.push_back(UniformFloor(i));
    AddStand(panoramas.back(), 0.08);
  }
  StandOptions options;
  options.margin_share = 0;
  const Stand stand = FindStand(panoramas, options);
  EXPECT_TRUE(stand.is_measured);
  EXPECT_NEAR(stand.masked_share, 0.08, 3.0 / 256);
}

TEST(FindStand, PicturesFromOnePlaceTellNothing) {
  const std::vector<ImageU8> same(5, Capture(1, 0.06)[0]);
  EXPECT_FALSE(FindStand(same, {}).is_measured);
}

TEST(FindStand, TooFewPictures) {
  EXPECT_FALSE(FindStand({}, {}).is_measured);
  EXPECT_FALSE(FindStand(Capture(1, 0.06), {}).is_measured);
  EXPECT_FALSE(FindStand(Capture(2, 0.06), {}).is_measured);
  StandOptions options;
  options.default_share = 0.2;
  EXPECT_EQ(FindStand(Capture(2, 0.06), options).masked_share, 0.2);
}

TEST(FindStand, OrderOfThePicturesDoesNotMatter) {
  auto panoramas = Capture(5, 0.07);
  const double share = FindStand(panoramas, {}).masked_share;
  std::reverse(panoramas.begin(), panoramas.end());
  EXPECT_EQ(FindStand(panoramas, {}).masked_share, share);
}

TEST(FindStand, LargePicturesAreShrunk) {
  std::vector<ImageU8> panoramas;
  for (const ImageU8& small : Capture(4, 0.1)) {
    ImageU8 large(2 * kRows + 1, 2 * kCols, 3);
    for (int r = 0; r < large.rows(); ++r) {
      for (int c = 0; c < large.cols(); ++c) {
        for (int k = 0; k < 3; ++k) large(r, c, k) = small(std::min(r / 2, kRows - 1), c / 2, k);
      }
    }
    panoramas.push_back(large);
  }
  EXPECT_EQ(FindStand(panoramas, {}).masked_share, FindStand(Capture(4, 0.1), {}).masked_share);
}

TEST(FindStand, GreyPicturesAndBugs) {
  std::vector<ImageU8> panoramas;
  for (uint32_t i = 0; i < 4; ++i) {
    panoramas.push_back(Floor(i, 1));
    AddStand(panoramas.back(), 0.08);
  }
  EXPECT_TRUE(FindStand(panoramas, {}).is_measured);
  panoramas.push_back(ImageU8(128, 256, 1));
  EXPECT_THROW((void)FindStand(panoramas, {}), std::logic_error);
}

class FindStandOfSceneTest : public testing::Test {
 protected:
  void AddView(const ImageU8& picture) {
    View view;
    view.picture = std::to_string(scene_.views.size()) + ".png";
    view.path = folder_ / view.picture;
    view.camera = EquirectangularCamera(picture.cols(), picture.rows());
    WriteImage(view.path, picture);
    scene_.views.push_back(view);
  }

  TempFolder folder_;
  Scene scene_;
  RunContext context_{2};
};

TEST_F(FindStandOfSceneTest, ReadsThePictures) {
  for (const ImageU8& picture : Capture(12, 0.08)) AddView(picture);
  const Stand stand = FindStandOfScene(scene_, {}, context_);
  EXPECT_TRUE(stand.is_measured);
  EXPECT_NEAR(stand.masked_share, 0.10, 3.0 / 256);
}

TEST_F(FindStandOfSceneTest, LeavesOutOtherSizesMasksAndPinholes) {
  AddView(ImageU8(64, 128, 3));
  for (const ImageU8& picture : Capture(4, 0.08)) AddView(picture);
  AddView(ImageU8(kRows, kCols, 3));
  scene_.views.back().mask_path = "mask.png";
  AddView(ImageU8(kRows, kCols, 3));
  scene_.views.back().camera = PinholeCamera(kCols, kRows, 100, 100, kCols / 2, kRows / 2);
  EXPECT_TRUE(FindStandOfScene(scene_, {}, context_).is_measured);
}

TEST_F(FindStandOfSceneTest, TooFewAndMissingPictures) {
  EXPECT_FALSE(FindStandOfScene(scene_, {}, context_).is_measured);
  for (const ImageU8& picture : Capture(3, 0.08)) AddView(picture);
  std::filesystem::remove(scene_.views[1].path);
  EXPECT_THROW((void)FindStandOfScene(scene_, {}, context_), IoError);
  scene_.views.pop_back();
  EXPECT_FALSE(FindStandOfScene(scene_, {}, context_).is_measured);
}

TEST(Stand, NumTrustedRows) {
  EXPECT_EQ((Stand{0.1, true}.NumTrustedRows(1024)), 921);
  EXPECT_EQ((Stand{0, true}.NumTrustedRows(1024)), 1024);
  EXPECT_EQ((Stand{1, true}.NumTrustedRows(1024)), 0);
}

TEST(TrustedPixels, StandRowsOfPanoramasOnly) {
  View view;
  view.camera = EquirectangularCamera(40, 20);
  const ImageU8 mask = TrustedPixels(view, {0.25, true});
  ASSERT_EQ(mask.rows(), 20);
  ASSERT_EQ(mask.cols(), 40);
  for (int r = 0; r < 20; ++r) EXPECT_EQ(mask(r, 7), r < 15 ? 255 : 0);
  view.camera = PinholeCamera(40, 30, 20, 20, 20, 15);
  EXPECT_EQ(TrustedPixels(view, {0.25, true}).data(), std::vector<uint8_t>(1200, 255));
}

TEST(TrustedPixels, TheUsersMaskOverrides) {
  const TempFolder folder;
  ImageU8 drawn(20, 40, 1, 200);
  drawn(3, 5) = 0;
  drawn(4, 5) = 1;
  WriteImage(folder / "mask.png", drawn);
  View view;
  view.camera = EquirectangularCamera(40, 20);
  view.mask_path = folder / "mask.png";
  const ImageU8 mask = TrustedPixels(view, {0.25, true});
  EXPECT_EQ(mask(3, 5), 0);
  EXPECT_EQ(mask(4, 5), 255);
  EXPECT_EQ(mask(19, 0), 255);
}

TEST(TrustedPixels, BadMasksAreErrors) {
  const TempFolder folder;
  View view;
  view.picture = "a.jpg";
  view.camera = EquirectangularCamera(40, 20);
  view.mask_path = folder / "mask.png";
  EXPECT_THROW((void)TrustedPixels(view, {}), IoError);
  WriteImage(view.mask_path, ImageU8(10, 20, 1, 255));
  EXPECT_THROW((void)TrustedPixels(view, {}), InvalidInputError);
}

}  // namespace
}  // namespace enfilade
