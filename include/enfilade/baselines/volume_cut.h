// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/baselines/surface_report.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// The price of the surface is that of a depth of voxels whose votes all agree: smoothness_m of 5
/// cm takes away what is narrower than four times as much and not filled in, such as the beams of
/// stray rays, and leaves half a doorway.
struct VolumeCutOptions {
  double voxel_m = 0.05;
  double smoothness_m = 0.05;
  double good_share = 0.25;
  double max_range_m = 15;
  double max_megavoxels = 50;
  double min_hole_m2 = 0.25;
  double min_room_m2 = 0.25;

  void Visit(OptionVisitor& v);
};

/// The rival of the paper in three dimensions. Every voxel of a volume along the axes of the home
/// is inside, that is free, or outside. Minimises, exactly,
///
///   Σ_inside filled(v) + Σ_outside empty(v) + λ · number of faces between inside and outside that
///   no point lies on
///
/// with λ = smoothness_m / voxel_m. `empty` is the share of rays that cross a voxel on their way
/// from a camera to a point it sees, `filled` the share that ends just before it; voxels that no
/// ray reaches cost nothing. Voxels at the volume's border are outside. Parts that no camera stands
/// in are dropped. What hangs together of the surface in one plane then moves along its normal to
/// the weighted mean of the points near it, by less than half a voxel (voxel_surface.h).
///
/// Guarantees: the model's surface is closed, each edge shared by two triangles, and free of
/// intersections; the same result for any number of threads. Fewer than kMinSurfacePoints points
/// with a normal and a view, a volume above max_megavoxels and a cut without a part that holds a
/// camera give kNoSurface and the reason. Requires one profile a view. Memory about 65 bytes a
/// voxel and 200 a point. Throws StoppedError, and what AccumulateEvidence throws.
///
/// Furukawa, Curless, Seitz & Szeliski, "Reconstructing Building Interiors from Images" (ICCV
/// 2009), which Cabral & Furukawa (CVPR 2014, supplement, Fig. 8) compare with; where its numbers
/// come from tells docs/algorithms/baselines.md.
[[nodiscard]] SurfaceReport CutVolume(const Scene& scene, const Structure& structure,
                                      const std::vector<ScenePoint>& points,
                                      const VolumeCutOptions& options, RunContext& context);

}  // namespace enfilade
