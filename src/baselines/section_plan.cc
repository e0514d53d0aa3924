// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/baselines/section_plan.h"

#include <algorithm>
#include <utility>

#include "enfilade/base/check.h"
#include "enfilade/evidence/accumulate.h"
#include "enfilade/floorplan/assemble.h"
#include "enfilade/structure/wall_samples.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> CamerasOf(const Scene& scene, const Structure& structure, size_t storey_idx) {
  std::vector<Vector3d> cameras;
  for (const View& view : scene.views) {
    if (view.storey_idx == static_cast<int>(storey_idx))
      cameras.push_back(structure.home_from_world * view.world_from_cam.translation);
  }
  return cameras;
}

// Counts, which say how well walls were seen.
std::vector<EvidenceGrids> CountsOf(const Scene& scene, const Structure& structure,
                                    RunContext& context, std::string& reason) {
  std::vector<EvidenceGrids> grids;
  for (size_t i = 0; i < structure.storeys.size(); ++i) {
    EvidenceReport evidence =
        AccumulateEvidence(MakeWallSamples(structure, scene, static_cast<int>(i)), {},
                           {.mode = EvidenceMode::kCounts}, context);
    if (evidence.outcome != EvidenceOutcome::kDone) reason = evidence.reason;
    grids.push_back(std::move(evidence.grids));
  }
  return grids;
}

}  // namespace

std::vector<double> CameraHeights(const Scene& scene, const Structure& structure) {
  std::vector<double> heights;
  for (size_t i = 0; i < structure.storeys.size(); ++i) {
    const StoreyStructure& storey = structure.storeys[i];
    std::vector<double> z;
    for (const Vector3d& camera : CamerasOf(scene, structure, i)) z.push_back(camera.z());
    const auto middle = z.begin() + static_cast<ptrdiff_t>(z.size() / 2);
    if (!z.empty()) std::nth_element(z.begin(), middle, z.end());
    heights.push_back(z.empty() ? 0.5 * (storey.floor_z + storey.ceiling_z) : *middle);
  }
  return heights;
}

void TakeSections(const Scene& scene, const Structure& structure,
                  const std::vector<MultiPolygon2>& sections, double min_room_m2,
                  RunContext& context, SurfaceReport& report) {
  ENFILADE_CHECK(sections.size() == structure.storeys.size());
  const std::vector<EvidenceGrids> evidence = CountsOf(scene, structure, context, report.reason);
  if (!report.reason.empty()) return;
  std::vector<MultiPolygon2> rooms(sections.size());
  size_t num_rooms = 0;
  for (size_t i = 0; i < sections.size(); ++i) {
    const std::vector<Vector3d> cameras = CamerasOf(scene, structure, i);
    for (const Polygon2& part : sections[i]) {
      const bool holds_camera =
          std::any_of(cameras.begin(), cameras.end(),
                      [&](const Vector3d& camera) { return Contains(part, camera.head<2>()); });
      if (holds_camera && Area(part) >= min_room_m2) rooms[i].push_back(part);
    }
    num_rooms += rooms[i].size();
  }
  if (num_rooms == 0) {
    report.reason = "no part of the section at camera height is large enough and holds a camera";
    return;
  }
  report.plan = AssembleFloorplan(scene, structure, evidence, rooms, FloorplanOptions());
  report.outcome = SurfaceOutcome::kFound;
}

}  // namespace enfilade
