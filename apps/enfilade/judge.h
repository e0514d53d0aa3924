// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "enfilade/base/run_context.h"
#include "enfilade/evaluate/evaluate.h"
#include "enfilade/exchange/ground_truth.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/model/types.h"
#include "enfilade/pipeline/manifest.h"
#include "enfilade/pipeline/workspace.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// What the stages that have run left behind; there is a scene.
struct Results {
  std::optional<Scene> scene;
  std::optional<Structure> structure;
  std::optional<Floorplan> floorplan;
  std::optional<BuildingModel> model;  ///< without textures
};

/// Throws InvalidInputError when not even the first stage has a result, IoError.
[[nodiscard]] Results LoadResults(const Workspace& workspace, const Manifest& manifest);

/// Adds what the run cost, in time and memory.
void AddCosts(const Manifest& manifest, MetricReport& figures);

/// Compares what is in a result folder, locked by the caller, with the truth: writes
/// evaluation.json, the overlay and, where there is a model and the truth knows depth or normals,
/// an error map per panorama there, and returns the figures. Those of the run against itself
/// (self_check.h) are among them where its plans stand. Throws InvalidInputError, IoError.
MetricReport JudgeResults(const Workspace& workspace, const Manifest& manifest,
                          const Results& results, const GroundTruth& truth, RunContext& context);

/// A figure with three digits for a table; n/a for none.
[[nodiscard]] std::string FigureText(const std::optional<double>& figure);

/// Another plan of the same home, judged. Refers to the plan, the model and the results it was made
/// from.
struct JudgedResult {
  EvaluationInput input;
  EvaluationReport report;
};

/// `model` may be null; its home frame is the plan's.
[[nodiscard]] JudgedResult JudgePlan(const Results& results, const Floorplan& plan,
                                     const BuildingModel* model, const GroundTruth& truth,
                                     RunContext& context);

/// Writes plan.svg and floorplan.json into the folder, which is made. Throws IoError.
void WritePlan(const std::filesystem::path& folder, const Floorplan& plan,
               const nlohmann::json& provenance);

/// Writes overlay.png and evaluation.json into the folder. Throws IoError.
void WriteJudgement(const std::filesystem::path& folder, const JudgedResult& judged,
                    const GroundTruth& truth);

/// Draws, judges and writes into OUT/perfect the plan that the stages after structure make, with
/// the options of the run, of the true wall profiles (WithTrueProfiles); returns its figures. What
/// is missing there better profiles cannot bring. Throws InvalidInputError where there is no
/// structure, IoError.
MetricReport JudgePerfectProfiles(const Workspace& workspace, const Manifest& manifest,
                                  const Results& results, const GroundTruth& truth,
                                  RunContext& context);

}  // namespace enfilade
