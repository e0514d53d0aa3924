// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/enfilade/self_check.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "apps/enfilade/judge.h"
#include "enfilade/base/check.h"
#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/base/json.h"
#include "enfilade/evaluate/report.h"
#include "enfilade/exchange/floorplan_json.h"
#include "enfilade/pipeline/leave_one_out.h"
#include "enfilade/pipeline/memory_need.h"
#include "enfilade/pipeline/pipeline.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

fs::path PlanFile(const Workspace& workspace, size_t view_idx) {
  return workspace.leave_one_out_folder() / fmt::format("plan_{:04}.json", view_idx);
}

// What determined the plan that is checked, and so the plans that check it.
std::string KeyOfPlan(const Manifest& manifest) {
  const StageRecord* record = manifest.Find("floorplan");
  return record != nullptr ? record->key : "";
}

// Whether the file holds the plan without a view for the result as it stands.
bool IsCurrent(const fs::path& file, const std::string& key) {
  if (!fs::exists(file)) return false;
  const nlohmann::json provenance = JsonObject(ReadJsonFile(file), "provenance", file.native());
  return JsonString(provenance, "checks", file.native()) == key;
}

// The views whose plans are to be made: those that enough others are left for.
std::vector<size_t> LeftOutViews(const Scene& scene) {
  std::vector<size_t> views;
  for (size_t i = 0; i < scene.views.size(); ++i) {
    if (CanPlanWithout(scene, static_cast<int>(i))) views.push_back(i);
  }
  return views;
}

// Passes the progress of one plan's stages on, saying which plan it is and when all will be done,
// and a request to stop back.
class PlanProgress final : public ProgressSink {
 public:
  PlanProgress(const RunContext& outer, size_t plan, size_t num_plans, double seconds_left)
      : outer_(outer), plan_(plan), num_plans_(num_plans), seconds_left_(seconds_left) {}

  void Report(std::string_view what, int64_t done, int64_t total, double) override {
    outer_.CheckStop();
    if (outer_.progress_sink() == nullptr) return;
    outer_.progress_sink()->Report(
        fmt::format("plan {} of {} without a panorama, {}", plan_ + 1, num_plans_, what), done,
        total, seconds_left_);
  }

 private:
  const RunContext& outer_;
  size_t plan_, num_plans_;
  double seconds_left_;
};

}  // namespace

void MakePlansWithoutEach(const Workspace& workspace, const Manifest& manifest,
                          const Results& results, RunContext& context) {
  if (!results.floorplan) {
    throw InvalidInputError(workspace.root().native(), "holds no plan", "run 'enfilade run' first");
  }
  const Scene scene = ReadSceneWithPictures(workspace);
  RequireMemory(scene, context);
  const std::string key = KeyOfPlan(manifest);
  std::vector<size_t> views = LeftOutViews(scene);
  std::erase_if(views, [&](size_t i) { return IsCurrent(PlanFile(workspace, i), key); });
  CreateFolder(workspace.leave_one_out_folder());
  const PipelineOptions options = OptionsOf(manifest);
  const Clock::time_point start = Clock::now();
  for (size_t k = 0; k < views.size(); ++k) {
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    const double seconds_left =
        k > 0 ? seconds / static_cast<double>(k) * static_cast<double>(views.size() - k) : -1;
    // What the stages say of each plan would drown what was said of the run.
    RunContext quiet(context.num_threads(), manifest.seed, context.max_memory_mb());
    quiet.set_progress_sink(std::make_shared<PlanProgress>(context, k, views.size(), seconds_left));
    const Floorplan plan = PlanWithout(scene, static_cast<int>(views[k]), options, quiet);
    WriteFloorplanJson(
        PlanFile(workspace, views[k]), plan,
        {{"version", Version()}, {"without", scene.views[views[k]].picture}, {"checks", key}});
  }
}

std::optional<SelfReport> CheckSelf(const Workspace& workspace, const Manifest& manifest,
                                    const Results& results) {
  if (!results.structure || !fs::exists(workspace.leave_one_out_folder())) return std::nullopt;
  const std::string key = KeyOfPlan(manifest);
  std::vector<std::optional<Floorplan>> plans(results.scene->views.size());
  for (const size_t i : LeftOutViews(*results.scene)) {
    if (!IsCurrent(PlanFile(workspace, i), key)) return std::nullopt;
    plans[i] = ReadFloorplanJson(PlanFile(workspace, i));
  }
  return ScorePredictions(*results.scene, *results.structure, plans);
}

void JudgeSelf(const Workspace& workspace, const Manifest& manifest, const Results& results) {
  const std::optional<SelfReport> report = CheckSelf(workspace, manifest, results);
  ENFILADE_CHECK(report.has_value());
  MetricReport figures = EmptyReport();
  AddCosts(manifest, figures);
  // Judgements of the same result stay: they are removed when a stage runs again.
  nlohmann::json json = fs::exists(workspace.evaluation_file())
                            ? ReadJsonFile(workspace.evaluation_file())
                            : ReportToJson(figures);
  json["self_score"] = ReportToJson(MetricReport{{"self_score", report->score}})["self_score"];
  json["self_panoramas"] = SelfReportToJson(*report);
  WriteJsonFile(workspace.evaluation_file(), json);
  std::fputs(FormatSelfReport(*report).c_str(), stdout);
}

}  // namespace enfilade
