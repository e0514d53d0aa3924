// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/image/xmp.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/image/codec.h"
#include "tests/support/temp_folder.h"
#include "tests/support/xmp_picture.h"

namespace enfilade {
namespace {

const std::string kPacket = GPanoPacket(R"(GPano:PosePitchDegrees="2.5")");

std::string PacketOf(const TempFolder& folder, const std::string& bytes) {
  WriteFileAtomic(folder / "picture", bytes);
  return ReadXmpPacket(folder / "picture");
}

TEST(ReadXmpPacket, FindsThePacketOfJpegAndPng) {
  const TempFolder folder;
  const ImageU8 image(8, 16, 3, 90);
  const std::string jpeg = EncodeImage(image, ".jpg"), png = EncodeImage(image, ".png");
  EXPECT_EQ(PacketOf(folder, JpegWithXmp(jpeg, kPacket)), kPacket);
  EXPECT_EQ(PacketOf(folder, PngWithXmp(png, kPacket)), kPacket);
  EXPECT_EQ(PacketOf(folder, jpeg), "");
  EXPECT_EQ(PacketOf(folder, png), "");
}

TEST(ReadXmpPacket, PassesOverOtherSegments) {
  const TempFolder folder;
  const std::string jpeg = EncodeImage(ImageU8(8, 16, 3, 90), ".jpg");
  const std::string exif = std::string("\xFF\xE1\x00\x0A", 4) + std::string("Exif\0\0ab", 8);
  const std::string with_xmp = JpegWithXmp(jpeg, kPacket);
  EXPECT_EQ(PacketOf(folder, with_xmp.substr(0, 2) + exif + with_xmp.substr(2)), kPacket);
}

TEST(ReadXmpPacket, PicturesWithMetadataAreReadAsEver) {
  const TempFolder folder;
  const ImageU8 image(8, 16, 3, 90);
  WriteFileAtomic(folder / "a.png", PngWithXmp(EncodeImage(image, ".png"), kPacket));
  EXPECT_EQ(ReadImageRgb(folder / "a.png").data(), image.data());
  WriteFileAtomic(folder / "a.jpg", JpegWithXmp(EncodeImage(image, ".jpg"), kPacket));
  EXPECT_EQ(ReadImageRgb(folder / "a.jpg").cols(), 16);
}

// Cut anywhere, a file gives the whole packet, what is left of it, or none.
TEST(ReadXmpPacket, StandsCutFiles) {
  const TempFolder folder;
  const ImageU8 image(8, 16, 3, 90);
  for (const std::string& whole : {JpegWithXmp(EncodeImage(image, ".jpg"), kPacket),
                                   PngWithXmp(EncodeImage(image, ".png"), kPacket)}) {
    for (size_t length = 0; length < 520; length += 13) {
      EXPECT_TRUE(kPacket.starts_with(PacketOf(folder, whole.substr(0, length)))) << length;
    }
  }
}

TEST(ReadXmpPacket, OtherFilesHaveNone) {
  const TempFolder folder;
  EXPECT_EQ(PacketOf(folder, ""), "");
  EXPECT_EQ(PacketOf(folder, "GIF89a" + kPacket), "");
  EXPECT_THROW(static_cast<void>(ReadXmpPacket(folder / "absent.jpg")), IoError);
}

}  // namespace
}  // namespace enfilade
