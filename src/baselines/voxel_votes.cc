// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/baselines/voxel_votes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace enfilade {
namespace {

using Eigen::Vector3d;

// Dearer than all that a voxel and its faces can cost.
constexpr int32_t kForced = 100'000'000;
constexpr int64_t kSamplesPerTask = 1 << 14;

struct Votes {
  std::vector<uint32_t> empty, filled;
  // Of the face below a voxel, across x, y and z: whether a sample lies on it.
  std::array<std::vector<uint8_t>, 3> is_sampled;
};

// Sums do not depend on the order of additions.
void Add(uint32_t& count) {
  std::atomic_ref<uint32_t>(count).fetch_add(1, std::memory_order_relaxed);
}

// Calls visit for each voxel of the frame on the segment from a to b. Amanatides & Woo, "A Fast
// Voxel Traversal Algorithm for Ray Tracing" (1987); steps are counted, so that it ends in the
// voxel of b.
template <typename Visit>
void TraverseVoxels(const VoxelFrame& frame, const Vector3d& a, const Vector3d& b, Visit&& visit) {
  Voxel voxel = frame.VoxelAt(a);
  const Voxel last = frame.VoxelAt(b);
  const Vector3d start = (a - frame.origin) / frame.voxel_m, span = (b - a) / frame.voxel_m;
  constexpr double kNever = std::numeric_limits<double>::infinity();
  std::array<double, 3> next{}, delta{};
  Voxel steps_left{};
  for (size_t k = 0; k < 3; ++k) {
    const double along = span[static_cast<int>(k)];
    const double past = start[static_cast<int>(k)] - voxel[k];
    delta[k] = along == 0 ? kNever : 1 / std::abs(along);
    next[k] = along == 0 ? kNever : (along < 0 ? past : 1 - past) * delta[k];
    steps_left[k] = std::abs(last[k] - voxel[k]);
    if (steps_left[k] == 0) next[k] = kNever;
  }
  for (;;) {
    if (frame.IsInside(voxel)) visit(frame.Index(voxel));
    const size_t k = static_cast<size_t>(std::min_element(next.begin(), next.end()) - next.begin());
    if (steps_left[k] == 0) return;
    voxel[k] += last[k] > voxel[k] ? 1 : -1;
    next[k] = --steps_left[k] == 0 ? kNever : next[k] + delta[k];
  }
}

void Vote(const VoxelFrame& frame, const SurfaceSample& sample, Votes& votes) {
  const Vector3d half = 0.5 * frame.voxel_m * sample.normal;
  const Voxel behind = frame.VoxelAt(sample.position - half);
  if (frame.IsInside(behind)) Add(votes.filled[frame.Index(behind)]);
  TraverseVoxels(frame, sample.camera, sample.position + half,
                 [&](size_t voxel) { Add(votes.empty[voxel]); });
  const SampleFace face = FaceOf(frame, sample);
  if (!frame.IsInside(face.above)) return;
  std::atomic_ref<uint8_t>(
      votes.is_sampled[static_cast<size_t>(face.axis)][frame.Index(face.above)])
      .store(1, std::memory_order_relaxed);
}

Votes Count(const VoxelFrame& frame, const std::vector<SurfaceSample>& samples,
            RunContext& context) {
  Votes votes;
  votes.empty.assign(frame.NumVoxels(), 0);
  votes.filled.assign(frame.NumVoxels(), 0);
  for (std::vector<uint8_t>& faces : votes.is_sampled) faces.assign(frame.NumVoxels(), 0);
  const auto num_samples = static_cast<int64_t>(samples.size());
  const int64_t num_tasks = (num_samples + kSamplesPerTask - 1) / kSamplesPerTask;
  ParallelFor(context, "rays", num_tasks, [&](int64_t task) {
    const int64_t end = std::min(num_samples, (task + 1) * kSamplesPerTask);
    for (int64_t i = task * kSamplesPerTask; i < end; ++i)
      Vote(frame, samples[static_cast<size_t>(i)], votes);
  });
  return votes;
}

bool IsAtBorder(const VoxelFrame& frame, const Voxel& voxel) {
  for (size_t k = 0; k < 3; ++k) {
    if (voxel[k] == 0 || voxel[k] + 1 == frame.size[k]) return true;
  }
  return false;
}

// Lays the faces below each voxel at the voxel below, where the cut has them.
std::vector<int32_t> FaceCosts(const VoxelFrame& frame, const std::vector<uint8_t>& is_sampled,
                               int axis, int32_t face_cost) {
  std::vector<int32_t> costs(frame.NumVoxels(), face_cost);
  const size_t stride = frame.Stride(axis);
  for (size_t i = stride; i < costs.size(); ++i) {
    if (is_sampled[i] != 0) costs[i - stride] = 0;
  }
  return costs;
}

// The number of votes that makes a voxel sure.
double GoodVotes(const Votes& votes, double good_share) {
  uint64_t sum = 0, num_voxels = 0;
  for (size_t i = 0; i < votes.empty.size(); ++i) {
    const uint64_t total = uint64_t{votes.empty[i]} + votes.filled[i];
    sum += total;
    num_voxels += total > 0;
  }
  return good_share * static_cast<double>(sum) /
         static_cast<double>(std::max<uint64_t>(num_voxels, 1));
}

}  // namespace

SampleFace FaceOf(const VoxelFrame& frame, const SurfaceSample& sample) {
  SampleFace face;
  sample.normal.cwiseAbs().maxCoeff(&face.axis);
  face.above = frame.VoxelAt(sample.position);
  const double in_voxels = (sample.position[face.axis] - frame.origin[face.axis]) / frame.voxel_m;
  const double plane = std::round(in_voxels);
  face.above[static_cast<size_t>(face.axis)] = static_cast<int>(plane);
  face.gap_m = (in_voxels - plane) * frame.voxel_m;
  return face;
}

GridCutProblem MakeVolumeProblem(const VoxelFrame& frame, const std::vector<SurfaceSample>& samples,
                                 const VolumeCosts& costs, RunContext& context) {
  const Votes votes = Count(frame, samples, context);
  GridCutProblem problem;
  problem.cols = frame.size[0];
  problem.rows = frame.size[1];
  problem.layers = frame.size[2];
  problem.east_capacity = FaceCosts(frame, votes.is_sampled[0], 0, costs.face);
  problem.north_capacity = FaceCosts(frame, votes.is_sampled[1], 1, costs.face);
  problem.up_capacity = FaceCosts(frame, votes.is_sampled[2], 2, costs.face);
  const double good = GoodVotes(votes, costs.good_share);
  problem.source_capacity.assign(frame.NumVoxels(), 0);
  problem.sink_capacity.assign(frame.NumVoxels(), 0);
  for (Voxel v{}; v[2] < frame.size[2]; ++v[2]) {
    for (v[1] = 0; v[1] < frame.size[1]; ++v[1]) {
      for (v[0] = 0; v[0] < frame.size[0]; ++v[0]) {
        const size_t i = frame.Index(v);
        if (IsAtBorder(frame, v)) {
          problem.sink_capacity[i] = kForced;
          continue;
        }
        const double empty = votes.empty[i], filled = votes.filled[i];
        const double vote = kVoxelVote / std::max({empty + filled, good, 1.0});
        problem.source_capacity[i] = static_cast<int32_t>(std::lround(vote * empty));
        problem.sink_capacity[i] = static_cast<int32_t>(std::lround(vote * filled));
      }
    }
  }
  return problem;
}

}  // namespace enfilade
