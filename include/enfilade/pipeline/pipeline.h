// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/evidence/types.h"
#include "enfilade/floorplan/solve.h"
#include "enfilade/pipeline/manifest.h"
#include "enfilade/pipeline/options.h"
#include "enfilade/pipeline/stage.h"
#include "enfilade/pipeline/workspace.h"
#include "enfilade/scene/types.h"

namespace enfilade {

/// The stages in flow order: sfm, points, structure, evidence, floorplan, model, export.
[[nodiscard]] std::span<const std::string_view> StageNames();

/// The options that the stages in a manifest ran with; defaults for stages that did not. Throws
/// InvalidInputError when the manifest holds an option that this version lacks.
[[nodiscard]] PipelineOptions OptionsOf(const Manifest& manifest);

/// The scene of a result folder. The dense cloud, where one was given, stands in place of the
/// points that registration found. Throws IoError, InvalidInputError.
[[nodiscard]] Scene ReadSceneOf(const Workspace& workspace);

/// The scene of a result folder for something that looks at its pictures. Throws IoError, and
/// InvalidInputError when one of them is no longer what sfm saw.
[[nodiscard]] Scene ReadSceneWithPictures(const Workspace& workspace);

/// Everything from a folder of pictures to the stage called `last_stage`, all files in `workspace`.
/// Stages whose results stand are skipped (see RunStages), so an interrupted run continues where it
/// was.
///
/// Nothing is written when the input is refused. Throws InvalidInputError, IoError, StoppedError.
[[nodiscard]] StageResult RunPipeline(const std::filesystem::path& input,
                                      const Workspace& workspace, const PipelineOptions& options,
                                      std::string_view last_stage, RunContext& context);

/// One stage after sfm again, from what the earlier ones left in `workspace`. Removes the results
/// of later stages. The stage points need not have run before structure. Throws InvalidInputError
/// when the stage before has no result there.
[[nodiscard]] StageResult RunSingleStage(const Workspace& workspace, const PipelineOptions& options,
                                         std::string_view stage, RunContext& context);

/// The floorplan that stands in `workspace` with another number of corners, from its rooms' curves:
/// the same files as the stage floorplan would write with its options and
/// FloorplanOptions::vertices, without solving again. Removes the results of later stages, but
/// writes a drawing that was there anew. Throws InvalidInputError when no plan stands there, it has
/// no curve, or there is no plan with so many corners.
[[nodiscard]] StageResult RedrawWithVertices(const Workspace& workspace, int num_vertices,
                                             RunContext& context);

/// True when stage `stage` has a result in the folder that a manifest is of.
[[nodiscard]] bool IsStageDone(const Manifest& manifest, std::string_view stage);

/// What the stage floorplan worked with and did, for a picture of it.
struct FloorplanExplanation {
  std::vector<EvidenceGrids> evidence;
  FloorplanReport report;
};

/// Solves again what led to the floorplan that stands in `workspace`, which must be locked and have
/// one. Writes nothing. Throws as the stage does.
[[nodiscard]] FloorplanExplanation ExplainFloorplan(const Workspace& workspace,
                                                    RunContext& context);

}  // namespace enfilade
