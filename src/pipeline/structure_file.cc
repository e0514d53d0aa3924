// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/structure_file.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/base/json.h"
#include "src/pipeline/binary_file.h"

namespace enfilade {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr std::string_view kFormat = "enfilade-structure";
constexpr std::string_view kProfileMagic = "ENFPROF1";
constexpr int kVersion = 1;
constexpr int kMaxColumns = 1 << 20;
constexpr int kMaxBins = 1 << 16;

fs::path ProfileFile(const fs::path& folder, size_t profile_idx) {
  return folder / fmt::format("profile_{:04}.bin", profile_idx);
}

[[noreturn]] void Fail(const std::string& where, const std::string& problem) {
  throw InvalidInputError(where, problem, "run 'enfilade structure OUT' again");
}

Json RigidToJson(const Rigid3& rigid) {
  Json numbers = Json::array();
  const Eigen::Matrix4d matrix = rigid.Matrix();
  for (int row = 0; row < 4; ++row) {
    for (int col = 0; col < 4; ++col) numbers.push_back(matrix(row, col));
  }
  return numbers;
}

std::vector<double> NumbersFromJson(const Json& object, const char* key, const std::string& where) {
  std::vector<double> numbers;
  for (const Json& value : JsonArray(object, key, where)) {
    if (!value.is_number() || !std::isfinite(value.get<double>())) {
      Fail(where, fmt::format("key '{}' holds something that is no number", key));
    }
    numbers.push_back(value.get<double>());
  }
  return numbers;
}

Rigid3 RigidFromJson(const Json& object, const char* key, const std::string& where) {
  const std::vector<double> numbers = NumbersFromJson(object, key, where);
  if (numbers.size() != 16) Fail(where, fmt::format("key '{}' has not 16 numbers", key));
  const auto matrix =
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
  return {matrix.topLeftCorner<3, 3>(), matrix.topRightCorner<3, 1>()};
}

void WriteProfileArrays(const fs::path& path, const WallProfile& profile) {
  const auto num_columns = profile.wall_m.size();
  ENFILADE_CHECK(profile.obstacle_m.size() == num_columns &&
                 profile.confidence.size() == num_columns &&
                 profile.is_seen.size() == num_columns &&
                 static_cast<size_t>(profile.wall_probability.rows()) == num_columns);
  BinaryWriter writer(kProfileMagic, kVersion);
  writer.Add(static_cast<int32_t>(num_columns));
  writer.Add(static_cast<int32_t>(profile.wall_probability.cols()));
  writer.AddArray(std::span(profile.wall_m));
  writer.AddArray(std::span(profile.obstacle_m));
  writer.AddArray(std::span(profile.confidence));
  writer.AddArray(std::span(profile.is_seen));
  writer.AddArray(std::span(profile.wall_probability.data()));
  WriteFileAtomic(path, writer.bytes());
}

void ReadProfileArrays(const fs::path& path, int num_bins, WallProfile& profile) {
  BinaryReader reader(path, kProfileMagic, kVersion);
  const auto num_columns = static_cast<size_t>(reader.GetSize(kMaxColumns));
  if (reader.GetSize(kMaxBins) != num_bins)
    Fail(path.native(), "has another number of bins than structure.json");
  reader.Require(num_columns *
                 (3 * sizeof(float) + 1 + sizeof(float) * static_cast<size_t>(num_bins)));
  profile.wall_m.resize(num_columns);
  profile.obstacle_m.resize(num_columns);
  profile.confidence.resize(num_columns);
  profile.is_seen.resize(num_columns);
  profile.wall_probability = ImageF(static_cast<int>(num_columns), num_bins);
  reader.GetFiniteArray(profile.wall_m);
  reader.GetFiniteArray(profile.obstacle_m);
  reader.GetFiniteArray(profile.confidence);
  reader.GetArray(std::span(profile.is_seen));
  reader.GetFiniteArray(profile.wall_probability.data());
  reader.Finish();
}

Json StoreyToJson(const StoreyStructure& storey) {
  return {{"floor_z", storey.floor_z},
          {"ceiling_z", storey.ceiling_z},
          {"baseboard_m", storey.baseboard_m}};
}

Json ProfileToJson(const WallProfile& profile) {
  return {{"view_idx", profile.view_idx},
          {"floor_z", profile.floor_z},
          {"ceiling_z", profile.ceiling_z},
          {"ceiling_weight", profile.ceiling_weight}};
}

}  // namespace

void WriteStructure(const fs::path& folder, const Structure& structure) {
  Json storeys = Json::array();
  for (const StoreyStructure& storey : structure.storeys) storeys.push_back(StoreyToJson(storey));
  Json profiles = Json::array();
  for (size_t i = 0; i < structure.profiles.size(); ++i) {
    const WallProfile& profile = structure.profiles[i];
    ENFILADE_CHECK(profile.wall_probability.cols() == static_cast<int>(structure.bin_m.size()));
    WriteProfileArrays(ProfileFile(folder, i), profile);
    profiles.push_back(ProfileToJson(profile));
  }
  WriteJsonFile(folder / "structure.json",
                {{"format", kFormat},
                 {"version", kVersion},
                 {"home_from_world", RigidToJson(structure.home_from_world)},
                 {"heading_rad", structure.heading_rad},
                 {"storeys", std::move(storeys)},
                 {"bin_m", structure.bin_m},
                 {"profiles", std::move(profiles)}});
}

Structure ReadStructure(const fs::path& folder) {
  const fs::path path = folder / "structure.json";
  const std::string where = path.native();
  const Json json = ReadJsonFile(path);
  if (JsonString(json, "format", where) != kFormat ||
      JsonInteger(json, "version", where) != kVersion) {
    Fail(where, "is no structure of this version");
  }
  Structure structure;
  structure.home_from_world = RigidFromJson(json, "home_from_world", where);
  structure.heading_rad = JsonNumber(json, "heading_rad", where);
  structure.bin_m = NumbersFromJson(json, "bin_m", where);
  if (structure.bin_m.size() > kMaxBins) Fail(where, "has too many bins");
  for (const Json& storey : JsonArray(json, "storeys", where)) {
    structure.storeys.push_back({JsonNumber(storey, "floor_z", where),
                                 JsonNumber(storey, "ceiling_z", where),
                                 JsonNumber(storey, "baseboard_m", where)});
  }
  for (const Json& item : JsonArray(json, "profiles", where)) {
    WallProfile profile;
    profile.view_idx = static_cast<int>(JsonInteger(item, "view_idx", where));
    profile.floor_z = JsonNumber(item, "floor_z", where);
    profile.ceiling_z = JsonNumber(item, "ceiling_z", where);
    profile.ceiling_weight = JsonNumber(item, "ceiling_weight", where);
    ReadProfileArrays(ProfileFile(folder, structure.profiles.size()),
                      static_cast<int>(structure.bin_m.size()), profile);
    structure.profiles.push_back(std::move(profile));
  }
  return structure;
}

}  // namespace enfilade
