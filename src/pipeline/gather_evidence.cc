// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/gather_evidence.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "enfilade/evidence/accumulate.h"
#include "enfilade/evidence/core.h"
#include "enfilade/evidence/point_labels.h"
#include "enfilade/structure/wall_samples.h"

namespace enfilade {
namespace {

// The scene's points in the home frame that views of the storey see, at its floor, at its ceiling
// or between them, with those views alone: rays from other storeys cross its plan nowhere.
EvidencePoints PointsOfStorey(const Scene& scene, const Structure& structure, size_t storey_idx) {
  const StoreyStructure& storey = structure.storeys[storey_idx];
  EvidencePoints points{.points = {},
                        .camera_positions = {},
                        .floor_z = storey.floor_z,
                        .ceiling_z = storey.ceiling_z};
  for (const View& view : scene.views) {
    points.camera_positions.push_back(structure.home_from_world * view.world_from_cam.translation);
  }
  for (const ScenePoint& point : scene.points) {
    ScenePoint in_home;
    in_home.position = structure.home_from_world * point.position;
    if (!IsAtStorey(in_home.position.z(), storey.floor_z, storey.ceiling_z)) continue;
    std::copy_if(point.view_idx.begin(), point.view_idx.end(), std::back_inserter(in_home.view_idx),
                 [&](int view_idx) {
                   return scene.views[static_cast<size_t>(view_idx)].storey_idx ==
                          static_cast<int>(storey_idx);
                 });
    if (in_home.view_idx.empty()) continue;
    in_home.normal = structure.home_from_world.rotation * point.normal;
    points.points.push_back(std::move(in_home));
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
