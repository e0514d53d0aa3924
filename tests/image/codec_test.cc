// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/image/codec.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

// Smooth, with a different period in each channel.
ImageU8 Picture(int rows, int cols, int channels) {
  ImageU8 image(rows, cols, channels);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < cols; ++c) {
      for (int k = 0; k < channels; ++k) {
        image(r, c, k) = static_cast<uint8_t>(128 + 100 * std::sin(0.1 * (k + 1) * r + 0.07 * c));
      }
    }
  }
  return image;
}

double MeanAbsDifference(const ImageU8& a, const ImageU8& b) {
  double sum = 0;
  for (size_t i = 0; i < a.data().size(); ++i) sum += std::abs(a.data()[i] - b.data()[i]);
  return sum / static_cast<double>(a.data().size());
}

std::string JpegSegment(uint8_t marker, const std::string& content) {
  const size_t length = content.size() + 2;
  return std::string({'\xFF', static_cast<char>(marker), static_cast<char>(length >> 8),
                      static_cast<char>(length & 255)}) +
         content;
}

TEST(Codec, PngRoundTripIsLossless) {
  const TempFolder folder;
  for (const int channels : {1, 3}) {
    const ImageU8 image = Picture(33, 65, channels);
    WriteImage(folder / "picture.PNG", image);
    const ImageU8 read = channels == 3 ? ReadImageRgb(folder / "picture.PNG")
                                       : ReadImageGray(folder / "picture.PNG");
    EXPECT_EQ(read.rows(), 33);
    EXPECT_EQ(read.cols(), 65);
    EXPECT_EQ(read.channels(), channels);
    EXPECT_EQ(read.data(), image.data());
  }
}

TEST(Codec, JpegKeepsColoursApart) {
  const TempFolder folder;
  for (const char* name : {"a.jpg", "a.jpeg", "a.JPG"}) {
    const ImageU8 image = Picture(64, 128, 3);
    WriteImage(folder / name, image);
    EXPECT_LT(MeanAbsDifference(ReadImageRgb(folder / name), image), 4);
  }
  ImageU8 red(16, 16, 3);
  for (int i = 0; i < 256; ++i) red.data()[static_cast<size_t>(3 * i)] = 255;
  WriteImage(folder / "red.jpg", red);
  const ImageU8 read = ReadImageRgb(folder / "red.jpg");
  EXPECT_GT(read(8, 8, 0), 250);
  EXPECT_LT(read(8, 8, 2), 5);
}

TEST(Codec, GrayOfAColourPictureAndColourOfAGrayOne) {
  const TempFolder folder;
  WriteImage(folder / "gray.png", ImageU8(4, 8, 1, 77));
  const ImageU8 rgb = ReadImageRgb(folder / "gray.png");
  EXPECT_EQ(rgb.channels(), 3);
  EXPECT_EQ(rgb.data(), std::vector<uint8_t>(96, 77));
  WriteImage(folder / "rgb.png", ImageU8(4, 8, 3, 99));
  EXPECT_EQ(ReadImageGray(folder / "rgb.png").data(), std::vector<uint8_t>(32, 99));
}

TEST(Codec, SameInputSameBytes) {
  const ImageU8 image = Picture(40, 80, 3);
  EXPECT_EQ(EncodeImage(image, ".png"), EncodeImage(image, ".png"));
  EXPECT_EQ(EncodeImage(image, ".jpg"), EncodeImage(image, ".jpg"));
  EXPECT_LT(EncodeImage(image, ".jpg", 30).size(), EncodeImage(image, ".jpg", 95).size());
}

TEST(Codec, WhatCannotBeEncodedIsABug) {
  EXPECT_THROW((void)EncodeImage({}, ".png"), std::logic_error);
  EXPECT_THROW((void)EncodeImage(ImageU8(2, 2, 2), ".png"), std::logic_error);
  EXPECT_THROW((void)EncodeImage(ImageU8(2, 2, 3), ".docx"), std::logic_error);
  EXPECT_THROW((void)EncodeImage(ImageU8(2, 2, 3), ""), std::logic_error);
}

TEST(ReadImageSize, JpegAndPng) {
  const TempFolder folder;
  for (const char* name : {"a.jpg", "a.png"}) {
    WriteImage(folder / name, Picture(30, 70, 3));
    const ImageSize size = ReadImageSize(folder / name);
    EXPECT_EQ(size.width, 70);
    EXPECT_EQ(size.height, 30);
  }
}

TEST(ReadImageSize, LooksAtTheContentAndNotAtTheName) {
  const TempFolder folder;
  WriteFileAtomic(folder / "really_png.jpg", EncodeImage(Picture(3, 5, 3), ".png"));
  EXPECT_EQ(ReadImageSize(folder / "really_png.jpg").width, 5);
  EXPECT_EQ(ReadImageRgb(folder / "really_png.jpg").cols(), 5);
}

TEST(ReadImageSize, WalksOverLongSegmentsAndFillBytes) {
  // Two full application segments (a thumbnail in one of them), a fill byte, then the frame.
  const TempFolder folder;
  const std::string jpeg = EncodeImage(Picture(30, 70, 3), ".jpg");
  const std::string thumbnail = EncodeImage(Picture(4, 4, 3), ".jpg");
  const std::string exif = thumbnail + std::string(60000 - thumbnail.size(), 'x');
  WriteFileAtomic(folder / "a.jpg", jpeg.substr(0, 2) + JpegSegment(0xE1, exif) +
                                        JpegSegment(0xE2, std::string(65533, '\xFF')) + "\xFF" +
                                        jpeg.substr(2));
  EXPECT_EQ(ReadImageSize(folder / "a.jpg").width, 70);
  EXPECT_EQ(ReadImageRgb(folder / "a.jpg").rows(), 30);
}

TEST(ReadImageSize, ReadsOnlyTheHead) {
  // A sparse terabyte behind the header is not touched.
  const TempFolder folder;
  WriteImage(folder / "a.jpg", Picture(30, 70, 3));
  fs::resize_file(folder / "a.jpg", uint64_t{1} << 40);
  EXPECT_EQ(ReadImageSize(folder / "a.jpg").width, 70);
}

TEST(Codec, DataBehindTheEndOfAJpegIsLeftAlone) {
  // Motion photos and some 360° cameras append megabytes of their own.
  const TempFolder folder;
  const ImageU8 image = Picture(30, 70, 3);
  WriteFileAtomic(folder / "a.jpg", EncodeImage(image, ".jpg") + std::string(100000, 't'));
  EXPECT_LT(MeanAbsDifference(ReadImageRgb(folder / "a.jpg"), image), 4);
}

TEST(Codec, TruncatedAnywhereIsRefused) {
  const TempFolder folder;
  for (const char* extension : {".jpg", ".png"}) {
    const std::string bytes = EncodeImage(Picture(40, 80, 3), extension);
    const fs::path path = folder / (std::string("cut") + extension);
    for (size_t size = 0; size + 2 < bytes.size(); size += 1 + bytes.size() / 50) {
      WriteFileAtomic(path, bytes.substr(0, size));
      EXPECT_THROW((void)ReadImageRgb(path), InvalidInputError) << extension << " " << size;
      EXPECT_THROW((void)ReadImageGray(path), InvalidInputError) << extension << " " << size;
    }
    for (size_t size = 0; size < 20; ++size) {
      WriteFileAtomic(path, bytes.substr(0, size));
      EXPECT_THROW((void)ReadImageSize(path), InvalidInputError) << extension << " " << size;
    }
  }
}

TEST(Codec, DamageNeverCrashes) {
  // Every seventh byte of the head is changed once: an error or a picture, nothing else.
  const TempFolder folder;
  testing::internal::CaptureStderr();  // libpng says on it what it finds
  for (const char* extension : {".jpg", ".png"}) {
    const std::string bytes = EncodeImage(Picture(8, 16, 3), extension);
    const fs::path path = folder / (std::string("bad") + extension);
    for (size_t i = 0; i < std::min<size_t>(bytes.size(), 400); i += 7) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(~damaged[i]);
      WriteFileAtomic(path, damaged);
      try {
        (void)ReadImageSize(path);
        (void)ReadImageRgb(path);
      } catch (const InvalidInputError&) {
      }
    }
  }
  (void)testing::internal::GetCapturedStderr();
}

TEST(Codec, NotAPicture) {
  const TempFolder folder;
  const std::string contents[] = {"",
                                  "\xFF\xD8",
                                  "not a picture",
                                  std::string(5000, '\0'),
                                  "\x89PNG\r\n\x1A\n",
                                  "\x89PNG\r\n\x1A\n" + std::string(100, 'x')};
  for (const std::string& content : contents) {
    WriteFileAtomic(folder / "a.jpg", content);
    EXPECT_THROW((void)ReadImageSize(folder / "a.jpg"), InvalidInputError);
    EXPECT_THAT([&] { (void)ReadImageRgb(folder / "a.jpg"); },
                ThrowsMessage<InvalidInputError>(HasSubstr("a.jpg: is no complete picture")));
  }
}

TEST(Codec, HugeSizeIsRefusedBeforeDecoding) {
  // A header that promises 60000 × 60000 pixels: 10 GB if it were believed.
  const TempFolder folder;
  std::string png = EncodeImage(Picture(8, 8, 3), ".png");
  for (const size_t i : {size_t{16}, size_t{20}}) {
    png[i] = png[i + 1] = 0;
    png[i + 2] = static_cast<char>(60000 >> 8);
    png[i + 3] = static_cast<char>(60000 & 255);
  }
  WriteFileAtomic(folder / "bomb.png", png);
  EXPECT_THAT([&] { (void)ReadImageSize(folder / "bomb.png"); },
              ThrowsMessage<InvalidInputError>(HasSubstr("2^28 pixels")));
  EXPECT_THAT([&] { (void)ReadImageRgb(folder / "bomb.png"); },
              ThrowsMessage<InvalidInputError>(HasSubstr("2^28 pixels")));
  for (const size_t i : {size_t{16}, size_t{20}}) png[i] = '\x80';  // negative as int
  WriteFileAtomic(folder / "bomb.png", png);
  EXPECT_THROW((void)ReadImageSize(folder / "bomb.png"), InvalidInputError);
}

TEST(Codec, MissingFoldersAndFiles) {
  const TempFolder folder;
  EXPECT_THROW((void)ReadImageRgb(folder / "missing.jpg"), IoError);
  EXPECT_THROW((void)ReadImageSize(folder / "missing.jpg"), IoError);
  EXPECT_THROW((void)ReadImageRgb(folder.path()), IoError);
  EXPECT_THROW(WriteImage("/proc/enfilade/a.png", Picture(4, 4, 3)), IoError);
}

TEST(Codec, NamesThatAreNotUtf8) {
  const TempFolder folder;
  const ImageU8 image = Picture(6, 12, 3);
  WriteImage(folder / "caf\xe9.png", image);
  EXPECT_EQ(ReadImageSize(folder / "caf\xe9.png").width, 12);
  EXPECT_EQ(ReadImageRgb(folder / "caf\xe9.png").data(), image.data());
  EXPECT_THAT([&] { (void)ReadImageRgb(folder / "th\xe9.png"); },
              ThrowsMessage<IoError>(HasSubstr("th\\xe9.png")));
}

}  // namespace
}  // namespace enfilade
