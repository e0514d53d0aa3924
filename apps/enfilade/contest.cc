// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/enfilade/contest.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "apps/enfilade/command.h"
#include "enfilade/base/child_program.h"
#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/base/hash.h"
#include "enfilade/base/json.h"
#include "enfilade/exchange/obj_writer.h"
#include "enfilade/model/extrude.h"
#include "enfilade/pipeline/memory.h"
#include "enfilade/pipeline/pipeline.h"
#include "enfilade/pipeline/stage.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Json = nlohmann::json;

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

fs::path RecordFile(const fs::path& folder) { return folder / "record.json"; }
fs::path LogFile(const fs::path& folder) { return folder / "log.txt"; }

Json RecordToJson(const ContestRecord& record) {
  return {{"outcome", EnumNames(record.outcome)[static_cast<size_t>(record.outcome)]},
          {"reason", record.reason},
          {"seconds", record.seconds},
          {"peak_memory_mb", record.peak_memory_mb},
          {"limit", record.limit}};
}

ContestRecord ReadRecord(const fs::path& path) {
  const Json json = ReadJsonFile(path);
  const std::string where = path.native();
  const auto names = EnumNames(MethodOutcome());
  const auto name = std::find(names.begin(), names.end(), JsonString(json, "outcome", where));
  if (name == names.end())
    throw InvalidInputError(where, "names no outcome", "delete it and compare again");
  return {static_cast<MethodOutcome>(name - names.begin()), JsonString(json, "reason", where),
          JsonNumber(json, "seconds", where), JsonNumber(json, "peak_memory_mb", where),
          JsonNumber(json, "limit", where)};
}

// Everything that determines what a contender finds.
std::string KeyOf(const Manifest& manifest, const Contender& contender, uint64_t seed) {
  return Sha256(fmt::format("{}\n{}\n{}\n{}\n{}", ProgramVersion(), seed,
                            manifest.Find("structure")->key, contender.name,
                            contender.options.dump()));
}

// What a method was given up at; 0 for those that were not.
double LimitOf(MethodOutcome outcome, const CompareOptions& options) {
  if (outcome == MethodOutcome::kOutOfTime) return options.max_seconds;
  return outcome == MethodOutcome::kOutOfMemory ? options.max_memory_mb : 0;
}

// The record of an earlier comparison, if it still stands.
std::optional<ContestRecord> StandingRecord(const fs::path& folder, const std::string& key,
                                            const CompareOptions& options) {
  if (StoredKey(RecordFile(folder)) != key) return std::nullopt;
  ContestRecord record = ReadRecord(RecordFile(folder));
  switch (record.outcome) {
    case MethodOutcome::kFound:
      if (fs::exists(folder / "floorplan.json")) return record;
      return std::nullopt;
    case MethodOutcome::kNoResult:
      return record;
    case MethodOutcome::kOutOfTime:
    case MethodOutcome::kOutOfMemory:
      if (record.limit >= LimitOf(record.outcome, options)) return record;
      return std::nullopt;
    case MethodOutcome::kFailed:
      return std::nullopt;
  }
  return std::nullopt;
}

// What a program said last: its error, if it named one.
std::string LastWords(const fs::path& log) {
  constexpr std::string_view kError = "error: ";
  const std::string text = ReadFile(log);
  const size_t start = text.rfind(kError);
  if (start == std::string::npos) return "";
  const size_t begin = start + kError.size();
  return text.substr(begin, text.find('\n', begin) - begin);
}

// The record of a process that left none of its own.
ContestRecord RecordOfEnd(const ProgramEnd& end, const std::string& last_words,
                          const CompareOptions& options) {
  if (end.excess == ProgramExcess::kTime)
    return {MethodOutcome::kOutOfTime,
            fmt::format("not done after {} s (--compare.max_seconds)", options.max_seconds)};
  if (end.excess == ProgramExcess::kMemory)
    return {MethodOutcome::kOutOfMemory, fmt::format("it needs more than {} MB of memory "
                                                     "(--compare.max_memory_mb)",
                                                     options.max_memory_mb)};
  if (end.signal == SIGKILL)
    return {MethodOutcome::kFailed, "it was killed, most likely because memory ran out"};
  if (end.signal != 0)
    return {MethodOutcome::kFailed,
            fmt::format("its process ended by signal {} ({})", end.signal, strsignal(end.signal))};
  return {MethodOutcome::kFailed,
          last_words.empty() ? "its process ended with " + end.Text() : last_words};
}

// The arguments that make this program run one contender as this comparison would.
std::vector<std::string> ArgumentsOf(const Workspace& workspace, const Contender& contender,
                                     const CompareOptions& options, const RunContext& context) {
  std::vector<std::string> arguments = {"compare",      workspace.root().native(),
                                        kContenderFlag, contender.name,
                                        "--threads",    std::to_string(context.num_threads()),
                                        "--seed",       std::to_string(context.seed()),
                                        "--max-memory", std::to_string(context.max_memory_mb())};
  CompareCommandOptions command{options};
  for (const OptionInfo& info : ListOptions(VisitorOf(command))) {
    arguments.push_back("--" + info.path);
    arguments.push_back(info.value);
  }
  return arguments;
}

ContestRecord RunInProcess(const Workspace& workspace, const Contender& contender,
                           const CompareOptions& options, RunContext& context) {
  const fs::path folder = workspace.compare_folder() / contender.name;
  const fs::path record_file = RecordFile(folder), log = LogFile(folder);
  const Clock::time_point start = Clock::now();
  const ProgramEnd end = RunProgram(
      "/proc/self/exe", ArgumentsOf(workspace, contender, options, context), log,
      [&] { context.CheckStop(); },
      {.seconds = options.max_seconds, .memory_mb = static_cast<double>(options.max_memory_mb)});
  if (end.IsSuccess() && fs::exists(record_file)) {
    fs::remove(log);
    return ReadRecord(record_file);
  }
  ContestRecord record = RecordOfEnd(end, LastWords(log), options);
  record.seconds = SecondsSince(start);
  record.peak_memory_mb = end.peak_memory_mb;
  RemoveFiles(workspace, {folder.lexically_relative(workspace.root())});
  return record;
}

void Announce(const Contender& contender, const ContestRecord& record, Log& log) {
  const std::string cost =
      fmt::format("{:.1f} s, {:.0f} MB", record.seconds, record.peak_memory_mb);
  if (record.outcome == MethodOutcome::kFound) {
    log.Info(contender.title + ": " + cost);
  } else {
    log.Warning(fmt::format("{} has no result after {}: {}", contender.title, cost, record.reason));
  }
}

}  // namespace

std::string StoredKey(const fs::path& file) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return "";
  const Json json = ReadJsonFile(file);
  return json.contains("key") ? JsonString(json, "key", file.native()) : "";
}

void RunContender(const Workspace& workspace, const Manifest& manifest, const Contender& contender,
                  RunContext& context) {
  Results results = LoadResults(workspace, manifest);
  if (contender.needs_pictures) results.scene = ReadSceneWithPictures(workspace);
  const Clock::time_point start = Clock::now();
  ContenderResult result = contender.run(results, context);
  ContestRecord record{result.reason.empty() ? MethodOutcome::kFound : MethodOutcome::kNoResult,
                       result.reason, SecondsSince(start), PeakMemoryMb()};
  const fs::path folder = workspace.compare_folder() / contender.name;
  if (record.outcome == MethodOutcome::kFound) {
    WritePlan(folder, result.plan,
              {{"version", Version()}, {"seed", manifest.seed}, {"options", contender.options}});
    const BuildingModel model =
        result.surface ? std::move(*result.surface) : ExtrudeFloorplan(result.plan);
    if (!model.faces.empty()) WriteObj(folder / "model.obj", model);
  }
  WriteJsonFile(RecordFile(folder), RecordToJson(record));
}

std::vector<ContestRecord> HoldContest(const Workspace& workspace, const Manifest& manifest,
                                       const std::vector<Contender>& contenders,
                                       const CompareOptions& options, RunContext& context) {
  std::vector<ContestRecord> records;
  for (const Contender& contender : contenders) {
    context.CheckStop();
    const fs::path folder = workspace.compare_folder() / contender.name;
    const std::string key = KeyOf(manifest, contender, context.seed());
    std::optional<ContestRecord> record = StandingRecord(folder, key, options);
    if (!record) {
      RemoveFiles(workspace, {folder.lexically_relative(workspace.root())});
      CreateFolder(folder);
      record = RunInProcess(workspace, contender, options, context);
      record->limit = LimitOf(record->outcome, options);
      Json json = RecordToJson(*record);
      json["key"] = key;
      WriteJsonFile(RecordFile(folder), json);
      Announce(contender, *record, context.log());
    }
    records.push_back(std::move(*record));
  }
  return records;
}

}  // namespace enfilade
