// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/enfilade/judge.h"
#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/baselines/orientation_map.h"
#include "enfilade/baselines/plane_cut.h"
#include "enfilade/evaluate/types.h"
#include "enfilade/evidence/types.h"
#include "enfilade/exchange/ground_truth.h"
#include "enfilade/pipeline/manifest.h"
#include "enfilade/pipeline/workspace.h"

namespace enfilade {

/// The rival and what it is given. `cut.lambda` is the lowest of three.
struct BaselineOptions {
  EvidenceMode evidence = EvidenceMode::kCounts;
  PlaneCutOptions cut;
  OrientationMapOptions orientation;

  void Visit(OptionVisitor& v) {
    v("evidence", evidence, "Grids that the cut is given; counts are those of the paper.");
    cut.Visit(v);
    v("orientation", orientation, "Orientation maps.");
  }
};

/// The same as the command line names it: --baseline.lambda.
struct BaselineCommandOptions {
  BaselineOptions baseline;

  void Visit(OptionVisitor& v) { v("baseline", baseline, "The rival's plans."); }
};

/// Name of the plan in mode paper.
inline constexpr const char* kPaperPlan = "paper";

/// A plan beside others.
struct RivalPlan {
  std::string name;
  Floorplan plan;
  double seconds = 0;    ///< that it took to draw it from the evidence
  MetricReport figures;  ///< empty without a truth
};

/// The evidence of a result folder in the wanted mode: what its stage left or, where that is of the
/// other mode, gathered anew from its structure with the options of the run. Throws
/// InvalidInputError when there is none.
[[nodiscard]] std::vector<EvidenceGrids> EvidenceInMode(const Workspace& workspace,
                                                        const Manifest& manifest,
                                                        const Results& results, EvidenceMode mode,
                                                        RunContext& context);

/// Draws the paper's plan from counts and the cuts at λ, 4λ and 16λ, as the paper compares them,
/// and writes each to a folder of its own below baselines/ of the result folder, which the caller
/// has locked: floorplan.json and plan.svg and, where there is a truth, evaluation.json and
/// overlay.png. A plan without rooms leaves no files. Throws IoError, InvalidInputError,
/// StoppedError.
[[nodiscard]] std::vector<RivalPlan> DrawBaselines(const Workspace& workspace,
                                                   const Manifest& manifest, const Results& results,
                                                   const std::optional<GroundTruth>& truth,
                                                   const BaselineOptions& options,
                                                   RunContext& context);

/// The run's own plan, if there is one, beside theirs. Throws as above.
[[nodiscard]] std::optional<RivalPlan> OwnPlan(const Manifest& manifest, const Results& results,
                                               const std::optional<GroundTruth>& truth);

/// A table for the terminal, a row a plan.
[[nodiscard]] std::string FormatRivals(const std::vector<RivalPlan>& plans);

}  // namespace enfilade
