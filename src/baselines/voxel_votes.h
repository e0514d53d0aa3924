// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/optim/grid_cut.h"
#include "src/baselines/oriented_points.h"
#include "src/baselines/voxel_frame.h"

namespace enfilade {

/// The cost of a voxel against which all of many votes are.
inline constexpr int32_t kVoxelVote = 1000;

/// What else the volume pays.
struct VolumeCosts {
  int32_t face = kVoxelVote;  ///< for a face that no sample lies on
  double good_share = 0.25;   ///< votes of a sure voxel, as a share of the mean in voxels with any
};

/// What the samples say about a volume, as a cut whose source side is the inside: rows are y, cols
/// x, layers z.
///
/// Each voxel on the ray from a camera to half a voxel before its sample gets a vote for empty, the
/// one half a voxel behind the sample, against its normal, a vote for filled. A voxel pays its
/// share of filled votes where it is inside and its share of empty ones where it is outside, of
/// kVoxelVote, less where it has fewer votes than make it sure. A face between voxels costs
/// nothing where a sample lies on it, that is where it is the face across the axis nearest to the
/// sample's normal that is nearest to the sample. Voxels at the border are outside. The same for
/// any number of threads. Cost O(samples · voxels crossed).
[[nodiscard]] GridCutProblem MakeVolumeProblem(const VoxelFrame& frame,
                                               const std::vector<SurfaceSample>& samples,
                                               const VolumeCosts& costs, RunContext& context);

/// The face that a sample lies on: across `axis`, between the voxel below it and `above`.
struct SampleFace {
  int axis = 0;
  Voxel above{0, 0, 0};
  double gap_m = 0;  ///< from the face's plane to the sample, along the axis
};
[[nodiscard]] SampleFace FaceOf(const VoxelFrame& frame, const SurfaceSample& sample);

}  // namespace enfilade
