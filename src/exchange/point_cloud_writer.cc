// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/point_cloud_writer.h"

#include <fmt/format.h>
#include <cstdint>
#include <string>

#include "enfilade/base/file.h"
#include "src/exchange/little_endian.h"

namespace enfilade {

void WriteVisibility(const std::filesystem::path& path, std::span<const ScenePoint> points) {
  std::string bytes;
  AppendLittleEndian(static_cast<uint64_t>(points.size()), bytes);
  for (const ScenePoint& point : points) {
    AppendLittleEndian(static_cast<uint32_t>(point.view_idx.size()), bytes);
    for (const int image : point.view_idx) AppendLittleEndian(static_cast<uint32_t>(image), bytes);
  }
  WriteFileAtomic(path, bytes);
}

void WritePatches(const std::filesystem::path& path, std::span<const ScenePoint> points) {
  std::string text = fmt::format("PATCHES\n{}\n", points.size());
  const auto add_line = [&](const Eigen::Vector3d& v, int fourth) {
    const Eigen::Vector3d single = v.cast<float>().cast<double>();
    text += fmt::format("{} {} {} {}\n", single.x(), single.y(), single.z(), fourth);
  };
  for (const ScenePoint& point : points) {
    text += "PATCHS\n";
    add_line(point.position, 1);
    add_line(point.normal, 0);
    text += fmt::format("1 0 0\n{}\n", point.view_idx.size());  // score, two for debugging
    for (const int image : point.view_idx) text += fmt::format("{} ", image);
    text += "\n0\n\n\n";
  }
  WriteFileAtomic(path, text);
}

}  // namespace enfilade
