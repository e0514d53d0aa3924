// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <string_view>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/pipeline/cloud.h"
#include "src/pipeline/binary_file.h"

namespace enfilade {
namespace {

constexpr std::string_view kMagic = "ENFCLOUD";
constexpr uint32_t kVersion = 1;
constexpr uint64_t kLeastPointBytes = 6 * sizeof(double) + 3 + sizeof(int32_t);

Eigen::Vector3d TakeVector(BinaryReader& reader) {
  const double x = reader.GetFinite(), y = reader.GetFinite(), z = reader.GetFinite();
  return {x, y, z};
}

}  // namespace

void WriteCloudFile(const std::filesystem::path& path, std::span<const ScenePoint> points) {
  BinaryWriter writer(kMagic, kVersion);
  writer.Add(static_cast<uint64_t>(points.size()));
  for (const ScenePoint& point : points) {
    writer.AddArray(std::span(point.position.data(), 3));
    writer.AddArray(std::span(point.normal.data(), 3));
    writer.AddArray(std::span(point.rgb.data(), 3));
    writer.Add(static_cast<int32_t>(point.view_idx.size()));
    writer.AddArray(std::span(point.view_idx));
  }
  WriteFileAtomic(path, writer.bytes());
}

std::vector<ScenePoint> ReadCloudFile(const std::filesystem::path& path, size_t num_views) {
  BinaryReader reader(path, kMagic, kVersion);
  const auto count = reader.Get<uint64_t>();
  if (count > UINT32_MAX) {
    throw InvalidInputError(path.native(), "contradicts itself", "run 'enfilade points OUT' again");
  }
  reader.Require(kLeastPointBytes * count);
  std::vector<ScenePoint> points(count);
  for (ScenePoint& point : points) {
    point.position = TakeVector(reader);
    point.normal = TakeVector(reader);
    reader.GetArray(std::span(point.rgb.data(), 3));
    point.view_idx.resize(static_cast<size_t>(reader.GetSize(static_cast<int>(num_views))));
    reader.GetArray(std::span(point.view_idx));
    for (const int view_idx : point.view_idx) {
      if (view_idx >= 0 && static_cast<size_t>(view_idx) < num_views) continue;
      throw InvalidInputError(path.native(), "names a view that the scene lacks",
                              "run 'enfilade points OUT' again");
    }
  }
  reader.Finish();
  return points;
}

}  // namespace enfilade
