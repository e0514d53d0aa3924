// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/image/codec.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

constexpr int64_t kMaxPixels = int64_t{1} << 28;
constexpr uint64_t kMaxFileBytes = uint64_t{1} << 30;

uint8_t Byte(std::string_view bytes, size_t i) { return static_cast<uint8_t>(bytes[i]); }
int BigEndian16(std::string_view bytes, size_t i) {
  return Byte(bytes, i) << 8 | Byte(bytes, i + 1);
}

// Walks the marker segments up to the frame header (ITU T.81, B.2.2).
ImageSize JpegSize(std::string_view bytes) {
  size_t i = 2;
  while (i + 9 < bytes.size()) {
    if (Byte(bytes, i) != 0xFF) return {};
    const uint8_t marker = Byte(bytes, i + 1);
    if (marker == 0xFF) {
      ++i;
      continue;
    }
    const bool is_frame =
        marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (is_frame) return {BigEndian16(bytes, i + 7), BigEndian16(bytes, i + 5)};
    i += 2 + static_cast<size_t>(BigEndian16(bytes, i + 2));
  }
  return {};
}

ImageSize PngSize(std::string_view bytes) {
  if (bytes.size() < 24) return {};
  return {BigEndian16(bytes, 16) << 16 | BigEndian16(bytes, 18),
          BigEndian16(bytes, 20) << 16 | BigEndian16(bytes, 22)};
}

[[noreturn]] void ThrowBadPicture(const fs::path& path) {
  throw InvalidInputError(path.native(), "is no complete picture", "give a whole JPEG or PNG file");
}

bool IsCutOff(std::string_view bytes) {
  // A decoder fills the missing part of a cut JPEG with grey; its end marker tells. Cameras may
  // append padding, so it is looked for in the last kilobyte.
  if (!bytes.starts_with("\xFF\xD8")) return false;
  const std::string_view tail = bytes.substr(bytes.size() - std::min<size_t>(bytes.size(), 1024));
  return tail.rfind("\xFF\xD9") == std::string_view::npos;
}

cv::Mat Decode(const fs::path& path, int flags) {
  const std::string bytes = ReadFile(path, kMaxFileBytes);
  if (bytes.empty() || IsCutOff(bytes)) ThrowBadPicture(path);
  const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
  cv::Mat decoded;
  try {
    decoded = cv::imdecode(raw, flags | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    ThrowBadPicture(path);
  }
  if (decoded.empty()) ThrowBadPicture(path);
  if (static_cast<int64_t>(decoded.rows) * decoded.cols > kMaxPixels) {
    throw InvalidInputError(path.native(), "has more than 2^28 pixels", "scale it down");
  }
  return decoded;
}

ImageU8 FromMat(const cv::Mat& mat) {
  ImageU8 image(mat.rows, mat.cols, mat.channels());
  for (int r = 0; r < mat.rows; ++r) {
    std::copy_n(mat.ptr<uint8_t>(r), mat.cols * mat.channels(), image.row(r));
  }
  return image;
}

}  // namespace

ImageSize ReadImageSize(const fs::path& path) {
  const std::string bytes = ReadFile(path, kMaxFileBytes);
  ImageSize size;
  if (bytes.starts_with("\xFF\xD8")) size = JpegSize(bytes);
  if (bytes.starts_with("\x89PNG\r\n\x1A\n")) size = PngSize(bytes);
  if (size.width <= 0 || size.height <= 0) ThrowBadPicture(path);
  return size;
}

ImageU8 ReadImageRgb(const fs::path& path) {
  cv::Mat decoded = Decode(path, cv::IMREAD_COLOR);
  cv::cvtColor(decoded, decoded, cv::COLOR_BGR2RGB);
  return FromMat(decoded);
}

ImageU8 ReadImageGray(const fs::path& path) { return FromMat(Decode(path, cv::IMREAD_GRAYSCALE)); }

std::string EncodeImage(const ImageU8& image, std::string_view extension, int jpeg_quality) {
  ENFILADE_CHECK(!image.empty() && (image.channels() == 1 || image.channels() == 3));
  cv::Mat mat(image.rows(), image.cols(), CV_8UC(image.channels()),
              const_cast<uint8_t*>(image.data().data()));
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
