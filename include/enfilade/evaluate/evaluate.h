// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/evaluate/columns.h"
#include "enfilade/evaluate/types.h"
#include "enfilade/exchange/ground_truth.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// What a run has produced so far; figures of what is null are none.
struct EvaluationInput {
  const Scene* scene = nullptr;  ///< required with `structure`, whose profiles point into it
  const Structure* structure = nullptr;
  const Floorplan* floorplan = nullptr;
};

struct EvaluateOptions {
  ColumnOptions columns;

  void Visit(OptionVisitor& v);
};

struct EvaluationReport {
  MetricReport figures;   ///< one entry for every key of FigureInfos()
  ColumnFigures columns;  ///< with the panoramas one by one
  int num_matched = 0;    ///< pictures of the result that the truth knows
  int num_changed = 0;    ///< of them, known by name alone: their content is another
};

/// Judges a result against the truth by docs/evaluation.md. The poses are taken as given: the
/// truth's world is the result's. Figures that come from the run's manifest (`seconds`,
/// `peak_memory_mb`) are left none for the caller to fill.
///
/// Throws InvalidInputError when result and truth both name pictures and none of them agree: the
/// truth belongs to another home. Warns when names agree and contents do not.
[[nodiscard]] EvaluationReport Evaluate(const EvaluationInput& input, const GroundTruth& truth,
                                        const EvaluateOptions& options, RunContext& context);

}  // namespace enfilade
