// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/ply_writer.h"

#include <fmt/format.h>
#include <bit>
#include <cstring>
#include <string>

#include "enfilade/base/file.h"

namespace enfilade {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY is written little-endian");

void AppendFloats(const Eigen::Vector3d& values, std::string& bytes) {
  const Eigen::Vector3f floats = values.cast<float>();
  char raw[sizeof(float) * 3];
  std::memcpy(raw, floats.data(), sizeof(raw));
  bytes.append(raw, sizeof(raw));
}

}  // namespace

void WritePointsPly(const std::filesystem::path& path, std::span<const ScenePoint> points) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment metres, z up\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
      points.size());
  for (const ScenePoint& point : points) {
    AppendFloats(point.position, bytes);
    AppendFloats(point.normal, bytes);
    for (const uint8_t channel : point.rgb) bytes.push_back(static_cast<char>(channel));
  }
  WriteFileAtomic(path, bytes);
}

}  // namespace enfilade
