// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/stage.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "enfilade/base/check.h"
#include "enfilade/base/errors.h"
#include "enfilade/base/hash.h"
#include "enfilade/pipeline/memory.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

std::map<std::string, std::string> OptionTexts(const VisitFunction& options) {
  std::map<std::string, std::string> texts;
  for (const OptionInfo& info : ListOptions(options)) texts[info.path] = info.value;
  return texts;
}

// Fields are joined with their lengths, so that no two lists of fields give the same text.
std::string StageKey(const Stage& stage, const std::string& key_before, const Manifest& manifest) {
  std::string text;
  const auto add = [&](const std::string& field) {
    text += std::to_string(field.size()) + ":" + field;
  };
  add(stage.name);
  add(manifest.program);
  add(std::to_string(manifest.seed));
  add(key_before);
  add(stage.inputs_hash);
  for (const auto& [path, value] : OptionTexts(stage.options)) {
    add(path);
    add(value);
  }
  return Sha256(text);
}

std::map<std::string, std::string> HashFiles(const Workspace& workspace, const Stage& stage) {
  std::map<std::string, std::string> hashes;
  for (const fs::path& file : ListFiles(workspace, stage.owns)) {
    hashes[file.native()] = Sha256OfFile(workspace.root() / file);
  }
  return hashes;
}

// True when the manifest has the stage as done under this key and its files are as it left them.
bool IsUpToDate(const Workspace& workspace, const Stage& stage, const std::string& key,
                const Manifest& manifest) {
  const StageRecord* record = manifest.Find(stage.name);
  return record != nullptr && record->key == key && record->outcome == StageOutcome::kDone &&
         record->artifacts == HashFiles(workspace, stage);
}

// Replaces the record of the same name, or adds one at the end.
void SetRecord(Manifest& manifest, const StageRecord& record) {
  const auto it = std::find_if(manifest.stages.begin(), manifest.stages.end(),
                               [&](const StageRecord& other) { return other.name == record.name; });
  if (it != manifest.stages.end()) {
    *it = record;
  } else {
    manifest.stages.push_back(record);
  }
}

// Forgets this stage and all after it: records in the manifest first, then files.
void Invalidate(const Workspace& workspace, std::span<const Stage> from,
                const std::vector<fs::path>& later_paths, Manifest& manifest) {
  const auto it =
      std::find_if(manifest.stages.begin(), manifest.stages.end(),
                   [&](const StageRecord& record) { return record.name == from.front().name; });
  manifest.stages.erase(it, manifest.stages.end());
  WriteManifest(workspace.manifest_file(), manifest);
  for (const Stage& stage : from) RemoveFiles(workspace, stage.owns);
  RemoveFiles(workspace, later_paths);
}

// Leaves nothing half-written and notes the failure. The error under way matters more than one of
// tidying up, and the next run tidies up again.
void TidyUpAfterFailure(const Workspace& workspace, const Stage& stage, const Manifest& manifest) {
  try {
    if (!stage.is_always_run) RemoveFiles(workspace, stage.owns);
    WriteManifest(workspace.manifest_file(), manifest);
  } catch (const IoError&) {
  }
}

StageResult RunStage(const Workspace& workspace, const Stage& stage, const std::string& key,
                     Manifest& manifest, RunContext& context) {
  StageRecord record{.name = stage.name,
                     .key = key,
                     .reason = {},
                     .options = OptionTexts(stage.options),
                     .artifacts = {}};
  const auto start = Clock::now();
  const auto finish = [&](StageOutcome outcome, const std::string& reason) {
    record.outcome = outcome;
    record.reason = reason;
    record.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    record.peak_memory_mb = std::round(PeakMemoryMb());
    SetRecord(manifest, record);
  };
  ResetPeakMemory();
  SetRecord(manifest, record);
  WriteManifest(workspace.manifest_file(), manifest);
  try {
    context.CheckStop();
    const StageResult result = stage.run(context);
    ENFILADE_CHECK(result.outcome == StageOutcome::kDone ||
                   result.outcome == StageOutcome::kNoResult);
    record.artifacts = HashFiles(workspace, stage);
    finish(result.outcome, result.reason);
    WriteManifest(workspace.manifest_file(), manifest);
    context.log().Info(
        fmt::format("{}: {:.1f} s, {:.0f} MB", stage.name, record.seconds, record.peak_memory_mb));
    return result;
  } catch (const StoppedError&) {
    finish(StageOutcome::kStopped, "stopped on request");
    TidyUpAfterFailure(workspace, stage, manifest);
    throw;
  } catch (const std::exception& error) {
    finish(StageOutcome::kFailed, error.what());
    TidyUpAfterFailure(workspace, stage, manifest);
    throw;
  }
}

}  // namespace

StageResult RunStages(const Workspace& workspace, std::span<const Stage> stages,
                      const std::string& first_key, const std::vector<fs::path>& later_paths,
                      Rerun rerun, Manifest& manifest, RunContext& context) {
  std::string key = first_key;
  StageResult result;
  for (size_t i = 0; i < stages.size(); ++i) {
    const Stage& stage = stages[i];
    key = StageKey(stage, key, manifest);
    const bool is_up_to_date = IsUpToDate(workspace, stage, key, manifest);
    if (is_up_to_date && rerun == Rerun::kWhenNeeded && !stage.is_always_run) {
      context.log().Info(stage.name + ": up to date");
      result = {};
      continue;
    }
    const StageRecord* record = manifest.Find(stage.name);
    const bool is_same_key = record != nullptr && record->key == key;
    if (!(stage.is_always_run && is_same_key)) {
      Invalidate(workspace, stages.subspan(i), later_paths, manifest);
    }
    result = RunStage(workspace, stage, key, manifest, context);
    if (result.outcome == StageOutcome::kNoResult) break;
  }
  return result;
}

std::string Version() { return ENFILADE_VERSION; }

std::string ProgramVersion() {
  static const std::string kProgram =
      Version() + "+" + Sha256OfFile("/proc/self/exe").substr(0, 12);
  return kProgram;
}

}  // namespace enfilade
