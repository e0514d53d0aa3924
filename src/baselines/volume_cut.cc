// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/baselines/volume_cut.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "enfilade/optim/grid_cut.h"
#include "src/baselines/oriented_points.h"
#include "src/baselines/section_plan.h"
#include "src/baselines/voxel_frame.h"
#include "src/baselines/voxel_joints.h"
#include "src/baselines/voxel_surface.h"
#include "src/baselines/voxel_votes.h"

namespace enfilade {
namespace {

// Dearer faces than this no evidence pays for.
constexpr double kMaxFaceCost = 1e7;

VolumeCosts CostsOf(const VolumeCutOptions& options) {
  const double face = kVoxelVote * options.smoothness_m / options.voxel_m;
  return {.face = static_cast<int32_t>(std::lround(std::min(face, kMaxFaceCost))),
          .good_share = options.good_share};
}

// Numbers what hangs together of the inside and holds a camera, from 1 in the order of the views; 0
// for the rest.
std::vector<uint16_t> PartsWithCamera(const VoxelFrame& frame, const std::vector<uint8_t>& inside,
                                      const Scene& scene, const Structure& structure) {
  std::vector<uint16_t> parts(inside.size(), 0);
  uint16_t num_parts = 0;
  std::vector<size_t> stack;
  for (const View& view : scene.views) {
    const Voxel camera = frame.VoxelAt(structure.home_from_world * view.world_from_cam.translation);
    if (!frame.IsInside(camera)) continue;
    const size_t first = frame.Index(camera);
    if (inside[first] == 0 || parts[first] != 0 || num_parts == UINT16_MAX) continue;
    parts[first] = ++num_parts;
    stack.push_back(first);
    while (!stack.empty()) {
      const size_t voxel = stack.back();
      stack.pop_back();
      // The volume's border is outside, so there are neighbours on all sides.
      for (int axis = 0; axis < 3; ++axis) {
        const size_t stride = frame.Stride(axis);
        for (const size_t next : {voxel - stride, voxel + stride}) {
          if (inside[next] == 0 || parts[next] != 0) continue;
          parts[next] = num_parts;
          stack.push_back(next);
        }
      }
    }
  }
  return parts;
}

}  // namespace

void VolumeCutOptions::Visit(OptionVisitor& v) {
  v("voxel_m", voxel_m, "Side of a voxel.", {0.01, 1});
  v("smoothness_m", smoothness_m, "Price of the surface, as the depth of clear evidence before it.",
    {0, 10});
  v("good_share", good_share,
    "Votes of a sure voxel, as a share of the mean number in voxels with any.", {0, 1000});
  v("max_range_m", max_range_m, "Points farther from their camera say nothing.", {1, 100});
  v("max_megavoxels", max_megavoxels, "Refuse volumes of more million voxels.", {0.001, 400});
  v("min_hole_m2", min_hole_m2, "Smaller holes in a room of the plan are filled.", {0, 100});
  v("min_room_m2", min_room_m2, "Smaller rooms of the plan are dropped.", {0, 100});
}

SurfaceReport CutVolume(const Scene& scene, const Structure& structure,
                        const std::vector<ScenePoint>& points, const VolumeCutOptions& options,
                        RunContext& context) {
  SurfaceReport report;
  const std::vector<SurfaceSample> samples =
      SamplesOf(scene, structure, points, options.max_range_m);
  report.reason = ReasonForTooFew(samples);
  if (!report.reason.empty()) return report;
  const VoxelFrame frame = FrameOf(samples, options.voxel_m);
  const double megavoxels = static_cast<double>(frame.NumVoxels()) / 1e6;
  if (megavoxels > options.max_megavoxels) {
    report.reason = fmt::format(
        "the volume has {:.1f} million voxels, the limit is {:g}: raise max_megavoxels or voxel_m",
        megavoxels, options.max_megavoxels);
    return report;
  }
  std::vector<uint8_t> inside =
      FindGridCut(MakeVolumeProblem(frame, samples, CostsOf(options), context)).is_source;
  context.CheckStop();
  JoinVoxels(frame, inside);
  std::vector<uint16_t> parts = PartsWithCamera(frame, inside, scene, structure);
  if (std::all_of(parts.begin(), parts.end(), [](uint16_t part) { return part == 0; })) {
    report.reason = "no part inside holds a camera";
    return report;
  }
  const VoxelSurface surface(frame, std::move(parts), samples);
  report.model = surface.Model(structure.storeys);
  context.CheckStop();
  PlanFromSections(
      scene, structure, [&](double z) { return surface.Section(z, options.min_hole_m2); },
      options.min_room_m2, context, report);
  return report;
}

}  // namespace enfilade
