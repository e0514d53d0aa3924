// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/baselines/section_plan.h"

#include <algorithm>
#include <utility>

#include "enfilade/base/median.h"
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

double MedianHeight(const std::vector<Vector3d>& points) {
  std::vector<double> heights;
  for (const Vector3d& point : points) heights.push_back(point.z());
  return UpperMedian(std::move(heights));
}

}  // namespace

void PlanFromSections(const Scene& scene, const Structure& structure,
                      const std::function<MultiPolygon2(double z)>& section_at, double min_room_m2,
                      RunContext& context, SurfaceReport& report) {
  const std::vector<EvidenceGrids> evidence = CountsOf(scene, structure, context, report.reason);
  if (!report.reason.empty()) return;
  std::vector<MultiPolygon2> rooms(structure.storeys.size());
  size_t num_rooms = 0;
  for (size_t i = 0; i < rooms.size(); ++i) {
    const std::vector<Vector3d> cameras = CamerasOf(scene, structure, i);
    if (cameras.empty()) continue;
    for (const Polygon2& part : section_at(MedianHeight(cameras))) {
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
