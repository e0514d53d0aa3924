// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/seen_picture.h"

#include <fmt/format.h>
#include <cstring>
#include <system_error>

#include "enfilade/base/check.h"
#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/base/hash.h"

namespace enfilade {
namespace {

constexpr std::string_view kMagic = "enfilade seen 3\n";
constexpr size_t kHashDigits = 64, kNameDigits = 16;
static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
static_assert(sizeof(Eigen::Matrix<uint8_t, 3, 1>) == 3);
static_assert(sizeof(LineSegment) == 6 * sizeof(double));

template <typename T>
void Append(const std::vector<T>& values, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

// Fills `values` with the next bytes and takes those away; false when there are too few.
template <typename T>
bool Take(std::string_view& bytes, std::vector<T>& values) {
  const size_t num_bytes = values.size() * sizeof(T);
  if (bytes.size() < num_bytes) return false;
  if (num_bytes > 0) std::memcpy(reinterpret_cast<char*>(values.data()), bytes.data(), num_bytes);
  bytes.remove_prefix(num_bytes);
  return true;
}

std::string Encode(const SeenPicture& seen) {
  const std::vector<uint32_t> sizes = {static_cast<uint32_t>(seen.features.size()),
                                       static_cast<uint32_t>(seen.segments.size()),
                                       static_cast<uint32_t>(seen.floor.contrast.data().size())};
  std::string bytes;
  Append(sizes, bytes);
  Append(seen.features.rays, bytes);
  Append(seen.features.sizes_rad, bytes);
  Append(seen.features.walls, bytes);
  Append(seen.features.descriptors.values, bytes);
  Append(seen.colours, bytes);
  Append(seen.segments, bytes);
  Append(seen.floor.contrast.data(), bytes);
  return bytes;
}

std::optional<SeenPicture> Decode(std::string_view bytes) {
  std::vector<uint32_t> sizes(3);
  if (!Take(bytes, sizes)) return std::nullopt;
  const size_t num_features = sizes[0], num_segments = sizes[1], num_floor = sizes[2];
  constexpr size_t kFloorPixels = size_t{FloorPicture::kSide} * FloorPicture::kSide;
  if (num_floor != 0 && num_floor != kFloorPixels) return std::nullopt;
  constexpr size_t kFeatureBytes = 3 * sizeof(float) + sizeof(float) + 1 + kDescriptorSize + 3;
  if (bytes.size() !=
      num_features * kFeatureBytes + num_segments * sizeof(LineSegment) + num_floor) {
    return std::nullopt;
  }
  SeenPicture seen;
  seen.features.rays.resize(num_features);
  seen.features.sizes_rad.resize(num_features);
  seen.features.walls.resize(num_features);
  seen.features.descriptors.values.resize(num_features * kDescriptorSize);
  seen.colours.resize(num_features);
  seen.segments.resize(num_segments);
  if (num_floor > 0) seen.floor.contrast = {FloorPicture::kSide, FloorPicture::kSide};
  const bool is_whole = Take(bytes, seen.features.rays) && Take(bytes, seen.features.sizes_rad) &&
                        Take(bytes, seen.features.walls) &&
                        Take(bytes, seen.features.descriptors.values) &&
                        Take(bytes, seen.colours) && Take(bytes, seen.segments) &&
                        Take(bytes, seen.floor.contrast.data());
  ENFILADE_CHECK(is_whole && bytes.empty());
  return seen;
}

std::string ReadIfAny(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return {};
  try {
    return ReadFile(file);
  } catch (const UserError&) {
    return {};
  }
}

}  // namespace

std::filesystem::path SeenPictureFile(const std::filesystem::path& folder, const View& view) {
  ENFILADE_CHECK(view.sha256.size() >= kNameDigits);
  return folder / (view.sha256.substr(0, kNameDigits) + ".bin");
}

std::string SeenPictureKey(const View& view, const ImageU8& trusted, const FeatureOptions& options,
                           std::string_view program) {
  const auto& pixels = trusted.data();
  const std::string_view trusted_bytes(reinterpret_cast<const char*>(pixels.data()), pixels.size());
  return Sha256(fmt::format("{} {} {} {} {} {} {}", view.sha256, trusted.rows(), trusted.cols(),
                            Sha256(trusted_bytes), options.max_features, options.min_contrast,
                            program));
}

std::optional<SeenPicture> LoadSeenPicture(const std::filesystem::path& file,
                                           std::string_view key) {
  const std::string bytes = ReadIfAny(file);
  std::string_view rest = bytes;
  for (const std::string_view part : {kMagic, key}) {
    if (!rest.starts_with(part)) return std::nullopt;
    rest.remove_prefix(part.size());
  }
  if (rest.size() < kHashDigits) return std::nullopt;
  const std::string_view hash = rest.substr(0, kHashDigits), payload = rest.substr(kHashDigits);
  if (Sha256(payload) != hash) return std::nullopt;
  return Decode(payload);
}

void SaveSeenPicture(const std::filesystem::path& file, std::string_view key,
                     const SeenPicture& seen) {
  const std::string payload = Encode(seen);
  WriteFileAtomic(file, std::string(kMagic) + std::string(key) + Sha256(payload) + payload);
}

}  // namespace enfilade
