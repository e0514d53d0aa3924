// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/npy.h"

#include <fmt/format.h>

#include <bit>
#include <string>

#include "enfilade/base/file.h"

namespace enfilade {
namespace {

static_assert(std::endian::native == std::endian::little);

template <typename T>
void Write(const std::filesystem::path& path, const Image<T>& image, const char* type) {
  const std::string channels = image.channels() > 1 ? fmt::format(", {}", image.channels()) : "";
  std::string header =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}, {}{}), }}", type,
                  image.rows(), image.cols(), channels);
  // Magic, version and length take ten bytes; the data starts at a multiple of 64.
  header.append(63 - (10 + header.size()) % 64, ' ');
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() & 0xFF);
  bytes += static_cast<char>(header.size() >> 8);
  bytes += header;
  bytes.append(reinterpret_cast<const char*>(image.data().data()), image.data().size() * sizeof(T));
  WriteFileAtomic(path, bytes);
}

}  // namespace

void WriteNpy(const std::filesystem::path& path, const Image<float>& image) {
  Write(path, image, "<f4");
}
void WriteNpy(const std::filesystem::path& path, const Image<int16_t>& image) {
  Write(path, image, "<i2");
}
void WriteNpy(const std::filesystem::path& path, const Image<int8_t>& image) {
  Write(path, image, "|i1");
}

}  // namespace enfilade
