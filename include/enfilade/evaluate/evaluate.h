// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/evaluate/columns.h"
#include "enfilade/evaluate/labels.h"
#include "enfilade/evaluate/model_error.h"
#include "enfilade/evaluate/poses.h"
#include "enfilade/evaluate/types.h"
#include "enfilade/exchange/ground_truth.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/geometry/rigid3.h"
#include "enfilade/model/types.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// What a run has produced so far; figures of what is null are none.
struct EvaluationInput {
  const Scene* scene = nullptr;  ///< required with `structure`, whose profiles point into it
  const Structure* structure = nullptr;
  const Floorplan* floorplan = nullptr;
  const BuildingModel* model = nullptr;  ///< requires `scene` and `floorplan`: its home frame
  LabelSource label_source = {};         ///< of the superpixels' labels, if there are any
  ModelErrorSink model_error_sink = {};  ///< is given the error map of every panorama, if set
};

struct EvaluateOptions {
  ColumnOptions columns;
  ModelErrorOptions model_error;

  void Visit(OptionVisitor& v);
};

struct EvaluationReport {
  MetricReport figures;               ///< one entry for every key of FigureInfos()
  Rigid3 truth_from_world;            ///< what the result was brought to the truth's world by
  std::vector<std::string> pictures;  ///< of the result, by view
  /// With the panoramas one by one.
  ColumnFigures columns;
  std::optional<PoseFigures> poses;
  LabelFigures labels;
  ModelErrorFigures model_error;
  int num_matched = 0;  ///< pictures of the result that the truth knows
  int num_changed = 0;  ///< of them, known by name alone: their content is another
};

/// Judges a result against the truth by docs/evaluation.md. Where the scene's poses were given, and
/// without a scene, the truth's world is the result's; where they were estimated
/// (PoseSource::kEstimated), the result is brought there first (FitTruthFromWorld). Figures that
/// come from the run's manifest (`seconds`, `peak_memory_mb`) are left none for the caller to fill.
///
/// Throws what the readers of pixel_truth.h throw, and InvalidInputError when result and truth both
/// name pictures and none of them agree: the truth belongs to another home. Warns when names agree
/// and contents do not.
[[nodiscard]] EvaluationReport Evaluate(const EvaluationInput& input, const GroundTruth& truth,
                                        const EvaluateOptions& options, RunContext& context);

}  // namespace enfilade
