// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/gather_evidence.h"

#include <utility>

#include "enfilade/evidence/accumulate.h"
#include "enfilade/evidence/core.h"
#include "enfilade/structure/wall_samples.h"

namespace enfilade {
namespace {

// The scene's points in the home frame that lie between the storey's floor and ceiling.
EvidencePoints PointsOfStorey(const Scene& scene, const Structure& structure, size_t storey_idx) {
  const StoreyStructure& storey = structure.storeys[storey_idx];
  EvidencePoints points{.points = {},
                        .camera_positions = {},
                        .floor_z = storey.floor_z,
                        .ceiling_z = storey.ceiling_z};
  for (const View& view : scene.views) {
    points.camera_positions.push_back(structure.home_from_world * view.world_from_cam.translation);
  }
  for (ScenePoint point : scene.points) {
    point.position = structure.home_from_world * point.position;
    point.normal = structure.home_from_world.rotation * point.normal;
    const bool is_in_storey =
        point.position.z() > storey.floor_z && point.position.z() < storey.ceiling_z;
    if (is_in_storey) points.points.push_back(std::move(point));
  }
  return points;
}

}  // namespace

EvidenceMode EvidenceModeOf(FloorplanMode mode) {
  return mode == FloorplanMode::kPaper ? EvidenceMode::kCounts : EvidenceMode::kLogOdds;
}

GatheredEvidence EvidenceOf(const Scene& scene, const Structure& structure,
                            const EvidenceOptions& options, EvidenceMode mode,
                            RunContext& context) {
  AccumulateOptions grid = options.grid;
  grid.mode = mode;
  GatheredEvidence gathered;
  for (size_t i = 0; i < structure.storeys.size(); ++i) {
    const WallSampleSet samples = MakeWallSamples(structure, scene, static_cast<int>(i));
    EvidenceReport report =
        AccumulateEvidence(samples, PointsOfStorey(scene, structure, i), grid, context);
    if (report.outcome != EvidenceOutcome::kDone) return {{}, 0, report.reason};
    CoreReport core = FindCore(report.grids, options.core, context);
    report.grids.core = std::move(core.core);
    report.grids.num_cores = core.num_cores;
    gathered.num_cores += core.num_cores;
    gathered.storeys.push_back(std::move(report.grids));
  }
  return gathered;
}

}  // namespace enfilade
