// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/enfilade/batch.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "apps/enfilade/command.h"
#include "apps/enfilade/judge.h"
#include "apps/enfilade/self_check.h"
#include "apps/enfilade/synth_home.h"
#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/base/json.h"
#include "enfilade/evaluate/batch.h"
#include "enfilade/exchange/ground_truth_reader.h"
#include "enfilade/pipeline/pipeline.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

struct BatchHome {
  std::string name;
  std::optional<SynthOptions> synth;  ///< to be made; else there are pictures
  fs::path pictures, truth;
};

bool IsFileName(const std::string& name) {
  return !name.empty() && name[0] != '.' && std::all_of(name.begin(), name.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.';
  });
}

void RequireKnownKeys(const Json& home, const std::string& where) {
  static const std::set<std::string> kKeys = {"name", "synth", "pictures", "truth"};
  for (const auto& [key, value] : home.items()) {
    if (kKeys.count(key) == 0)
      throw InvalidInputError(where, "has the unknown key '" + key + "'",
                              "use name, and synth or pictures and truth");
  }
}

BatchHome HomeFromJson(const Json& json, const fs::path& folder, const std::string& where) {
  if (!json.is_object()) throw InvalidInputError(where, "is no object", "see docs/evaluation.md");
  RequireKnownKeys(json, where);
  BatchHome home;
  home.name = JsonString(json, "name", where);
  if (!IsFileName(home.name)) {
    throw InvalidInputError(where, "has the name '" + home.name + "'",
                            "use letters, digits, '_', '-' and '.' only");
  }
  if (json.contains("synth") == json.contains("pictures")) {
    throw InvalidInputError(where, "has not exactly one of synth and pictures",
                            "say where the pictures are or which home to make");
  }
  if (json.contains("synth")) {
    home.synth.emplace();
    OptionsFromJson(VisitorOf(*home.synth), JsonObject(json, "synth", where), where);
    return home;
  }
  home.pictures = folder / JsonString(json, "pictures", where);
  home.truth = json.contains("truth") ? folder / JsonString(json, "truth", where) : home.pictures;
  return home;
}

std::vector<BatchHome> ReadBatchManifest(const fs::path& path) {
  const Json json = ReadJsonFile(path);
  if (!json.is_object())
    throw InvalidInputError(path.native(), "is no object", "see docs/evaluation.md");
  std::vector<BatchHome> homes;
  std::set<std::string> names;
  for (const Json& home : JsonArray(json, "homes", path.native())) {
    const std::string where = path.native() + ": home " + std::to_string(homes.size() + 1);
    homes.push_back(HomeFromJson(home, path.parent_path(), where));
    if (!names.insert(homes.back().name).second) {
      throw InvalidInputError(where, "has the name '" + homes.back().name + "' of another home",
                              "give every home its own name");
    }
  }
  if (homes.empty()) throw InvalidInputError(path.native(), "lists no homes", "add some");
  return homes;
}

// Makes the home unless the same options made what is there.
void MakeOnce(const fs::path& folder, SynthOptions options, RunContext& context) {
  const fs::path options_file = folder / "synth.json";
  const Json wanted = OptionsToJson(VisitorOf(options));
  std::error_code error;
  if (fs::exists(options_file, error) && ReadJsonFile(options_file) == wanted) return;
  fs::remove(options_file, error);
  (void)SynthesiseHome(folder, options, context);
  WriteJsonFile(options_file, wanted);
}

MetricReport JudgeHome(const BatchHome& home, const Workspace& workspace,
                       const PipelineOptions& options, bool is_self, RunContext& context) {
  const StageResult result = RunPipeline(home.pictures, workspace, options, "export", context);
  if (result.outcome == StageOutcome::kNoResult)
    throw InvalidInputError(home.name, "has no result", result.reason);
  const WorkspaceLock lock(workspace, WorkspaceUse::kExisting);
  const Manifest manifest = ReadManifest(workspace.manifest_file());
  const Results results = LoadResults(workspace, manifest);
  if (is_self) MakePlansWithoutEach(workspace, manifest, results, context);
  const GroundTruth truth = ReadGroundTruth(home.truth, results.scene->camera_height_m.value_or(0));
  return JudgeResults(workspace, manifest, results, truth, context);
}

void WriteTables(const fs::path& folder, const std::vector<JudgedHome>& homes) {
  WriteJsonFile(folder / "batch.json", BatchToJson(homes));
  WriteFileAtomic(folder / "batch.csv", BatchToCsv(homes));
  WriteFileAtomic(folder / "batch.md", BatchToMarkdown(homes));
}

}  // namespace

int RunBatch(const fs::path& manifest_file, const fs::path& folder, const PipelineOptions& options,
             bool is_self, RunContext& context) {
  std::vector<BatchHome> homes = ReadBatchManifest(manifest_file);
  CreateFolder(folder / "homes");
  CreateFolder(folder / "results");
  std::vector<JudgedHome> judged;
  for (BatchHome& home : homes) {
    context.log().Info("home " + std::to_string(judged.size() + 1) + " of " +
                       std::to_string(homes.size()) + ": " + home.name);
    JudgedHome outcome{home.name, "", {}};
    try {
      if (home.synth) {
        home.pictures = home.truth = folder / "homes" / home.name;
        MakeOnce(home.pictures, *home.synth, context);
      }
      outcome.figures =
          JudgeHome(home, Workspace(folder / "results" / home.name), options, is_self, context);
    } catch (const UserError& error) {
      outcome.error = error.what();
      context.log().Error(outcome.error);
    }
    judged.push_back(std::move(outcome));
    WriteTables(folder, judged);
  }
  std::fputs(BatchToMarkdown(judged).c_str(), stdout);
  const bool has_failed = std::any_of(judged.begin(), judged.end(),
                                      [](const JudgedHome& home) { return !home.error.empty(); });
  return has_failed ? kExitNoResult : kExitOk;
}

}  // namespace enfilade
