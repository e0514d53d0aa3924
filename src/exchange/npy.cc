// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/npy.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <regex>
#include <string>
#include <string_view>
#include <utility>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"

namespace enfilade {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr uint64_t kMaxValues = uint64_t{1} << 28;
constexpr uint64_t kMaxBytes = uint64_t{1} << 31;
constexpr size_t kMaxHeader = 4096;

template <typename T>
constexpr const char* kTypeName = nullptr;
template <>
constexpr const char* kTypeName<float> = "<f4";
template <>
constexpr const char* kTypeName<int16_t> = "<i2";
template <>
constexpr const char* kTypeName<int8_t> = "|i1";

template <typename T>
void Write(const std::filesystem::path& path, const Image<T>& image) {
  const std::string channels = image.channels() > 1 ? fmt::format(", {}", image.channels()) : "";
  std::string header =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}, {}{}), }}", kTypeName<T>,
                  image.rows(), image.cols(), channels);
  // Magic, version and length take ten bytes; the data starts at a multiple of 64.
  header.append(63 - (10 + header.size()) % 64, ' ');
  header += '\n';
  std::string bytes(kMagic);
  bytes += '\x01';
  bytes += '\x00';
  bytes += static_cast<char>(header.size() & 0xFF);
  bytes += static_cast<char>(header.size() >> 8);
  bytes += header;
  bytes.append(reinterpret_cast<const char*>(image.data().data()), image.data().size() * sizeof(T));
  WriteFileAtomic(path, bytes);
}

[[noreturn]] void Fail(const std::filesystem::path& path, const std::string& problem) {
  throw InvalidInputError(path.native(), problem, "make the file anew");
}

// The header's text and where the data starts.
std::pair<std::string, size_t> HeaderOf(const std::string& bytes,
                                        const std::filesystem::path& path) {
  if (!bytes.starts_with(kMagic) || bytes.size() < 12) Fail(path, "is no NumPy array file");
  const int version = bytes[6];
  if (version < 1 || version > 3) Fail(path, "is of an unknown version of NumPy's format");
  const size_t num_length_bytes = version == 1 ? 2 : 4;
  uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 8, num_length_bytes);
  const size_t begin = 8 + num_length_bytes;
  if (length > kMaxHeader) Fail(path, "has too long a header");
  if (length > bytes.size() - begin) Fail(path, "is cut");
  return {bytes.substr(begin, length), begin + length};
}

}  // namespace

void WriteNpy(const std::filesystem::path& path, const Image<float>& image) { Write(path, image); }
void WriteNpy(const std::filesystem::path& path, const Image<int16_t>& image) {
  Write(path, image);
}
void WriteNpy(const std::filesystem::path& path, const Image<int8_t>& image) { Write(path, image); }

template <typename T>
Image<T> ReadNpy(const std::filesystem::path& path) {
  static const std::regex kHeader(R"(\{'descr': '([^']*)', 'fortran_order': (True|False), )"
                                  R"('shape': \((\d{1,9}), (\d{1,9})(?:, (\d{1,3}))?\),? ?\}\s*)");
  const std::string bytes = ReadFile(path, kMaxBytes);
  const auto [header, data_begin] = HeaderOf(bytes, path);
  std::smatch parts;
  if (!std::regex_match(header, parts, kHeader) || parts[2] == "True") {
    Fail(path, "is no array of two or three axes in C order");
  }
  if (parts[1] != kTypeName<T>) {
    Fail(path, "holds numbers of type '" + parts[1].str() + "' instead of '" + kTypeName<T> + "'");
  }
  const uint64_t rows = std::stoull(parts[3]), cols = std::stoull(parts[4]);
  const uint64_t channels = parts[5].matched ? std::stoull(parts[5]) : 1;
  if (channels == 0 || rows * cols > kMaxValues || rows * cols * channels > kMaxValues) {
    Fail(path, "has an impossible shape");
  }
  if (bytes.size() - data_begin != rows * cols * channels * sizeof(T)) {
    Fail(path, "is longer or shorter than its header says");
  }
  Image<T> image(static_cast<int>(rows), static_cast<int>(cols), static_cast<int>(channels));
  if (!image.empty()) {
    std::memcpy(image.data().data(), bytes.data() + data_begin, bytes.size() - data_begin);
  }
  return image;
}

template Image<float> ReadNpy(const std::filesystem::path& path);
template Image<int16_t> ReadNpy(const std::filesystem::path& path);
template Image<int8_t> ReadNpy(const std::filesystem::path& path);

}  // namespace enfilade
