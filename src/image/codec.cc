// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/image/codec.h"

#include <algorithm>
#include <cctype>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "enfilade/base/check.h"
#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "src/image/jpeg_segments.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

constexpr int64_t kMaxPixels = int64_t{1} << 28;
constexpr uint64_t kMaxFileBytes = uint64_t{1} << 30;
constexpr std::string_view kJpegEnd = "\xFF\xD9";

// What the head of a file tells.
struct PictureHead {
  enum class Format { kJpeg, kPng, kOther };
  Format format = Format::kOther;
  ImageSize size;              // zero when it was not found
  uint64_t pixels_offset = 0;  // where the compressed pixels begin
};

bool IsFrameMarker(uint8_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

PictureHead ReadJpegHead(const FileReader& file) {
  constexpr size_t kFrameHeaderBytes = 9;  // marker, length, precision, height, width
  PictureHead head{PictureHead::Format::kJpeg, {}, 0};
  head.pixels_offset = WalkJpegSegments(file, [&](const JpegSegment& segment) {
    if (!IsFrameMarker(segment.marker)) return true;
    const std::string bytes = file.ReadAt(segment.offset, kFrameHeaderBytes);
    if (bytes.size() == kFrameHeaderBytes) {
      head.size = {BigEndian16(bytes, 7), BigEndian16(bytes, 5)};
    }
    return true;
  });
  return head;
}

// The header chunk comes first (ISO 15948, 11.2.2).
PictureHead ReadPngHead(const FileReader& file) {
  PictureHead head{PictureHead::Format::kPng, {}, 33};
  const std::string bytes = file.ReadAt(0, 24);
  if (bytes.size() < 24 || bytes.substr(12, 4) != "IHDR") return head;
  head.size = {BigEndian16(bytes, 16) << 16 | BigEndian16(bytes, 18),
               BigEndian16(bytes, 20) << 16 | BigEndian16(bytes, 22)};
  return head;
}

PictureHead ReadHead(const FileReader& file) {
  const std::string start = file.ReadAt(0, kPngStart.size());
  if (start.starts_with(kJpegStart)) return ReadJpegHead(file);
  if (start == kPngStart) return ReadPngHead(file);
  return {};
}

[[noreturn]] void ThrowBadPicture(const fs::path& path) {
  throw InvalidInputError(path.native(), "is no complete picture", "give a whole JPEG or PNG file");
}

void CheckSize(const fs::path& path, const ImageSize& size) {
  if (size.width <= 0 || size.height <= 0) ThrowBadPicture(path);
  if (int64_t{size.width} * size.height > kMaxPixels) {
    throw InvalidInputError(path.native(), "has more than 2^28 pixels", "scale it down");
  }
}

// Decoders fill the missing part of a cut file with grey and complain on standard error, so the end
// is looked for first. Cameras may append data of their own behind it.
bool IsCutOff(const PictureHead& head, std::string_view bytes) {
  if (head.format == PictureHead::Format::kOther) return false;
  const bool is_jpeg = head.format == PictureHead::Format::kJpeg;
  const size_t end = bytes.rfind(is_jpeg ? kJpegEnd : std::string_view("IEND"));
  return head.pixels_offset == 0 || end == std::string_view::npos || end < head.pixels_offset;
}

cv::Mat Decode(const fs::path& path, int flags) {
  const std::string bytes = ReadFile(path, kMaxFileBytes);
  const PictureHead head = ReadHead(FileReader(path));
  if (head.format != PictureHead::Format::kOther) CheckSize(path, head.size);
  if (bytes.empty() || IsCutOff(head, bytes)) ThrowBadPicture(path);
  const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
  cv::Mat decoded;
  try {
    decoded = cv::imdecode(raw, flags | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    ThrowBadPicture(path);
  }
  CheckSize(path, {decoded.cols, decoded.rows});
  return decoded;
}

// A view of the image's own memory.
cv::Mat MatOf(ImageU8& image) {
  return {image.rows(), image.cols(), CV_8UC(image.channels()), image.data().data()};
}

bool IsWritable(std::string_view extension) {
  std::string lower(extension);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower == ".png" || lower == ".jpg" || lower == ".jpeg";
}

}  // namespace

ImageSize ReadImageSize(const fs::path& path) {
  const ImageSize size = ReadHead(FileReader(path)).size;
  CheckSize(path, size);
  return size;
}

ImageU8 ReadImageRgb(const fs::path& path) {
  const cv::Mat decoded = Decode(path, cv::IMREAD_COLOR);
  ImageU8 image(decoded.rows, decoded.cols, 3);
  cv::Mat rgb = MatOf(image);
  cv::cvtColor(decoded, rgb, cv::COLOR_BGR2RGB);
  return image;
}

ImageU8 ReadImageGray(const fs::path& path) {
  const cv::Mat decoded = Decode(path, cv::IMREAD_GRAYSCALE);
  ImageU8 image(decoded.rows, decoded.cols, 1);
  cv::Mat gray = MatOf(image);
  decoded.copyTo(gray);
  return image;
}

std::string EncodeImage(const ImageU8& image, std::string_view extension, int jpeg_quality) {
  ENFILADE_CHECK(!image.empty() && (image.channels() == 1 || image.channels() == 3));
  ENFILADE_CHECK_MSG(IsWritable(extension), std::string(extension));
  cv::Mat mat = MatOf(const_cast<ImageU8&>(image));  // only read
  cv::Mat bgr;
  if (image.channels() == 3) {
    cv::cvtColor(mat, bgr, cv::COLOR_RGB2BGR);
    mat = bgr;
  }
  std::vector<uint8_t> bytes;
  ENFILADE_CHECK(
      cv::imencode(std::string(extension), mat, bytes, {cv::IMWRITE_JPEG_QUALITY, jpeg_quality}));
  return {bytes.begin(), bytes.end()};
}

void WriteImage(const fs::path& path, const ImageU8& image, int jpeg_quality) {
  WriteFileAtomic(path, EncodeImage(image, path.extension().native(), jpeg_quality));
}

}  // namespace enfilade
