// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/manifest.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "enfilade/base/errors.h"
#include "enfilade/base/json.h"

namespace enfilade {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr std::string_view kFormat = "enfilade-manifest";
constexpr int kVersion = 1;

Json TextMapToJson(const std::map<std::string, std::string>& map) {
  Json json = Json::object();
  for (const auto& [key, value] : map) json[key] = value;
  return json;
}

std::map<std::string, std::string> TextMapFromJson(const Json& json, const std::string& where) {
  std::map<std::string, std::string> map;
  for (const auto& [key, value] : json.items()) map[key] = JsonString(json, key.c_str(), where);
  return map;
}

Json RecordToJson(const StageRecord& record) {
  return {{"name", record.name},
          {"key", record.key},
          {"outcome", EnumNames(StageOutcome{})[static_cast<size_t>(record.outcome)]},
          {"reason", record.reason},
          {"seconds", record.seconds},
          {"peak_memory_mb", record.peak_memory_mb},
          {"options", TextMapToJson(record.options)},
          {"artifacts", TextMapToJson(record.artifacts)}};
}

StageOutcome OutcomeFromName(const std::string& name, const std::string& where) {
  const auto names = EnumNames(StageOutcome{});
  const auto it = std::find(names.begin(), names.end(), name);
  if (it == names.end()) {
    throw InvalidInputError(where, "has the unknown outcome '" + name + "'",
                            "remove the folder and run again");
  }
  return static_cast<StageOutcome>(it - names.begin());
}

StageRecord RecordFromJson(const Json& json, const std::string& where) {
  StageRecord record;
  record.name = JsonString(json, "name", where);
  record.key = JsonString(json, "key", where);
  record.outcome = OutcomeFromName(JsonString(json, "outcome", where), where);
  record.reason = JsonString(json, "reason", where);
  record.seconds = JsonNumber(json, "seconds", where);
  record.peak_memory_mb = JsonNumber(json, "peak_memory_mb", where);
  record.options = TextMapFromJson(JsonObject(json, "options", where), where);
  record.artifacts = TextMapFromJson(JsonObject(json, "artifacts", where), where);
  return record;
}

}  // namespace

std::span<const std::string_view> EnumNames(StageOutcome) {
  static constexpr std::array<std::string_view, 5> kNames = {"running", "done", "no_result",
                                                             "failed", "stopped"};
  return kNames;
}

const StageRecord* Manifest::Find(std::string_view name) const {
  const auto it = std::find_if(stages.begin(), stages.end(),
                               [&](const StageRecord& record) { return record.name == name; });
  return it == stages.end() ? nullptr : &*it;
}

Manifest ReadManifest(const fs::path& path) {
  const std::string where = path.native();
  const Json json = ReadJsonFile(path);
  if (!json.is_object() || json.value("format", Json()) != kFormat) {
    throw InvalidInputError(where, "is no manifest of this program",
                            "choose another folder with -o");
  }
  if (JsonInteger(json, "version", where) != kVersion) {
    throw InvalidInputError(where, "was written by another version of this program",
                            "remove the folder or choose another one with -o");
  }
  Manifest manifest;
  manifest.program = JsonString(json, "program", where);
  manifest.input = JsonString(json, "input", where);
  manifest.num_threads = static_cast<int>(JsonInteger(json, "num_threads", where));
  manifest.seed = static_cast<uint64_t>(JsonInteger(json, "seed", where));
  manifest.pictures = TextMapFromJson(JsonObject(json, "pictures", where), where);
  for (const Json& stage : JsonArray(json, "stages", where)) {
    manifest.stages.push_back(RecordFromJson(stage, where));
  }
  return manifest;
}

void WriteManifest(const fs::path& path, const Manifest& manifest) {
  Json stages = Json::array();
  for (const StageRecord& record : manifest.stages) stages.push_back(RecordToJson(record));
  WriteJsonFile(path, {{"format", kFormat},
                       {"version", kVersion},
                       {"program", manifest.program},
                       {"input", manifest.input},
                       {"num_threads", manifest.num_threads},
                       {"seed", manifest.seed},
                       {"pictures", TextMapToJson(manifest.pictures)},
                       {"stages", std::move(stages)}});
}

}  // namespace enfilade
