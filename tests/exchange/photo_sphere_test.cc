// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/photo_sphere.h"

#include <gtest/gtest.h>

#include <cmath>

#include "enfilade/geometry/angles.h"
#include "tests/support/xmp_picture.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

PhotoSphere Parse(const std::string& attributes) {
  return ParsePhotoSphere(GPanoPacket(attributes));
}

TEST(ParsePhotoSphere, ReadsAttributesAndElements) {
  const PhotoSphere attributes = Parse(
      R"(GPano:PosePitchDegrees="-2.5" GPano:PoseRollDegrees="+1" )"
      R"(GPano:FullPanoWidthPixels="8192" GPano:FullPanoHeightPixels="4096" )"
      R"(GPano:CroppedAreaImageWidthPixels="6000" GPano:CroppedAreaImageHeightPixels="3000")");
  EXPECT_EQ(attributes.pitch_deg, -2.5);
  EXPECT_EQ(attributes.roll_deg, 1);
  ASSERT_TRUE(attributes.full_size && attributes.cropped_size);
  EXPECT_EQ(attributes.full_size->width, 8192);
  EXPECT_EQ(attributes.cropped_size->height, 3000);
  // As Ricoh's cameras write them, under a prefix of the writer's choice.
  const PhotoSphere elements = ParsePhotoSphere(
      "<x:xmpmeta xmlns:x='adobe:ns:meta/'><rdf:RDF xmlns:rdf='r'><rdf:Description xmlns:p='g'>"
      "<p:PosePitchDegrees> 3.5\n</p:PosePitchDegrees><p:PoseRollDegrees>-7</p:PoseRollDegrees>"
      "</rdf:Description></rdf:RDF></x:xmpmeta>");
  EXPECT_EQ(elements.pitch_deg, 3.5);
  EXPECT_EQ(elements.roll_deg, -7);
}

TEST(ParsePhotoSphere, BrokenMetadataTellNothing) {
  EXPECT_FALSE(ParsePhotoSphere("").UpInCam());
  EXPECT_FALSE(ParsePhotoSphere("<x:xmpmeta><rdf").UpInCam());
  EXPECT_FALSE(ParsePhotoSphere(std::string("\0\xFF\xFE", 3)).UpInCam());
  for (const char* value : {"", "north", "nan", "inf", "91", "-1e9", "2,5", "3 4"}) {
    EXPECT_FALSE(Parse(std::string("GPano:PosePitchDegrees=\"") + value + "\"").UpInCam()) << value;
  }
  const PhotoSphere no_size =
      Parse(R"(GPano:FullPanoWidthPixels="0" GPano:FullPanoHeightPixels="4096" )"
            R"(GPano:CroppedAreaImageWidthPixels="1e30" GPano:CroppedAreaImageHeightPixels="-1")");
  EXPECT_FALSE(no_size.full_size || no_size.cropped_size);
}

// A camera that looks upward by the pitch has what is overhead towards the front; a horizon that
// turns counter-clockwise takes it to the left.
TEST(PhotoSphere, TellsTheVertical) {
  EXPECT_TRUE(Parse(R"(GPano:PosePitchDegrees="0")").UpInCam()->isApprox(Vector3d(0, -1, 0)));
  const Vector3d pitched = *Parse(R"(GPano:PosePitchDegrees="10")").UpInCam();
  EXPECT_TRUE(pitched.isApprox(Vector3d(0, -std::cos(DegToRad(10)), std::sin(DegToRad(10)))));
  const Vector3d rolled = *Parse(R"(GPano:PoseRollDegrees="10")").UpInCam();
  EXPECT_TRUE(rolled.isApprox(Vector3d(-std::sin(DegToRad(10)), -std::cos(DegToRad(10)), 0)));
  const Vector3d over =
      *Parse(R"(GPano:PosePitchDegrees="5" GPano:PoseRollDegrees="180")").UpInCam();
  EXPECT_GT(over.y(), 0.99);
  EXPECT_NEAR(over.norm(), 1, 1e-12);
}

TEST(PhotoSphere, TellsParts) {
  const auto sizes = [](const std::string& full, const std::string& part) {
    const auto tag = [](const std::string& name, const std::string& size) {
      const size_t x = size.find('x');
      return "GPano:" + name + "WidthPixels=\"" + size.substr(0, x) + "\" GPano:" + name +
             "HeightPixels=\"" + size.substr(x + 1) + "\" ";
    };
    return Parse(tag("FullPano", full) + tag("CroppedAreaImage", part));
  };
  EXPECT_TRUE(sizes("8192x4096", "8192x2000").IsCropped({8192, 2000}));
  EXPECT_TRUE(sizes("8192x4096", "4000x2000").IsCropped({4000, 2000}));
  EXPECT_TRUE(sizes("8192x4096", "4000x2000").IsCropped({2000, 1000}));  // scaled down since
  EXPECT_FALSE(sizes("8192x4096", "8192x4096").IsCropped({8192, 4096}));
  // Filled up to a whole panorama since.
  EXPECT_FALSE(sizes("8192x4096", "8192x2000").IsCropped({8192, 4096}));
  EXPECT_FALSE(Parse("").IsCropped({4000, 2000}));
}

}  // namespace
}  // namespace enfilade
