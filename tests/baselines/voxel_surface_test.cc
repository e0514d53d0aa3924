// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/baselines/voxel_surface.h"

#include <gtest/gtest.h>

#include <random>

#include "src/baselines/voxel_joints.h"
#include "src/baselines/voxel_votes.h"
#include "tests/support/model_checks.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

VoxelFrame MakeFrame(int cols, int rows, int layers, double voxel_m = 0.1) {
  return {.origin = {-1, 2, 0.5}, .voxel_m = voxel_m, .size = {cols, rows, layers}};
}

template <typename Visit>
void ForEachVoxel(const VoxelFrame& frame, int margin, Visit&& visit) {
  for (int z = margin; z + margin < frame.size[2]; ++z) {
    for (int y = margin; y + margin < frame.size[1]; ++y) {
      for (int x = margin; x + margin < frame.size[0]; ++x) visit(Voxel{x, y, z});
    }
  }
}

std::vector<uint8_t> RandomInside(const VoxelFrame& frame, double share, std::mt19937& random) {
  std::vector<uint8_t> inside(frame.NumVoxels(), 0);
  ForEachVoxel(frame, 1, [&](const Voxel& v) {
    inside[frame.Index(v)] = std::uniform_real_distribution<>(0, 1)(random) < share;
  });
  return inside;
}

std::vector<uint16_t> OnePart(const std::vector<uint8_t>& inside) {
  return {inside.begin(), inside.end()};
}

int NumSet(const std::vector<uint8_t>& inside) {
  return static_cast<int>(std::count(inside.begin(), inside.end(), 1));
}

TEST(JoinVoxels, AddsOnlyAndSettles) {
  std::mt19937 random(1);
  const VoxelFrame frame = MakeFrame(9, 8, 7);
  for (int trial = 0; trial < 30; ++trial) {
    const std::vector<uint8_t> before = RandomInside(frame, 0.03 * trial, random);
    std::vector<uint8_t> after = before;
    JoinVoxels(frame, after);
    for (size_t i = 0; i < before.size(); ++i) EXPECT_GE(after[i], before[i]);
    std::vector<uint8_t> again = after;
    JoinVoxels(frame, again);
    EXPECT_EQ(again, after);
    int num_inner = 0;
    ForEachVoxel(frame, 1, [&](const Voxel& v) { num_inner += after[frame.Index(v)]; });
    EXPECT_EQ(num_inner, NumSet(after));
  }
}

TEST(JoinVoxels, LeavesABoxAlone) {
  const VoxelFrame frame = MakeFrame(6, 6, 6);
  std::vector<uint8_t> inside(frame.NumVoxels(), 0);
  ForEachVoxel(frame, 2, [&](const Voxel& v) { inside[frame.Index(v)] = 1; });
  JoinVoxels(frame, inside);
  EXPECT_EQ(NumSet(inside), 8);
}

TEST(JoinVoxels, JoinsWhatTouchesAtAnEdgeOrACorner) {
  const VoxelFrame frame = MakeFrame(6, 6, 6);
  for (const Voxel& other : {Voxel{3, 3, 2}, Voxel{2, 3, 3}, Voxel{3, 3, 3}, Voxel{1, 3, 1}}) {
    std::vector<uint8_t> inside(frame.NumVoxels(), 0);
    inside[frame.Index({2, 2, 2})] = inside[frame.Index(other)] = 1;
    JoinVoxels(frame, inside);
    EXPECT_GE(NumSet(inside), 3);
    EXPECT_LE(NumSet(inside), 8);
    ExpectWatertight(VoxelSurface(frame, OnePart(inside), {}).Model({}));
  }
}

// Whatever the inside is, its surface is closed and holds as much as the voxels do.
TEST(VoxelSurface, IsClosedRoundRandomVoxels) {
  std::mt19937 random(2);
  const VoxelFrame frame = MakeFrame(11, 10, 9);
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<uint8_t> inside = RandomInside(frame, 0.02 * (trial + 1), random);
    JoinVoxels(frame, inside);
    const BuildingModel model = VoxelSurface(frame, OnePart(inside), {}).Model({});
    ExpectWatertight(model);
    EXPECT_NEAR(EnclosedVolumes(model)[std::pair(0, 0)], NumSet(inside) * 1e-3, 1e-9);
  }
}

// With samples all over, every component moves, each by its own amount: still no gap and no turned
// triangle.
TEST(VoxelSurface, StaysClosedWhenPlanesMove) {
  std::mt19937 random(3);
  const VoxelFrame frame = MakeFrame(11, 10, 9);
  std::uniform_real_distribution<> unit(0, 1);
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<uint8_t> inside = RandomInside(frame, 0.02 * (trial + 1), random);
    JoinVoxels(frame, inside);
    std::vector<SurfaceSample> samples;
    for (int i = 0; i < 3000; ++i) {
      const Vector3d p =
          frame.origin + Vector3d(unit(random), 0.9 * unit(random), 0.8 * unit(random));
      samples.push_back({p, (i % 2 == 0 ? 1.0 : -1.0) * Vector3d::Unit(i % 3), p});
    }
    ExpectWatertight(VoxelSurface(frame, OnePart(inside), samples).Model({}));
  }
}

TEST(VoxelSurface, PlanesLieWhereTheirSamplesDo) {
  const VoxelFrame frame = MakeFrame(8, 8, 8);
  std::vector<uint8_t> inside(frame.NumVoxels(), 0);
  ForEachVoxel(frame, 2, [&](const Voxel& v) { inside[frame.Index(v)] = 1; });
  // The box lies from 0.2 to 0.6 after the origin. Its west wall 3 cm farther east and its floor 2
  // cm lower; what looks the other way belongs to something else.
  const Vector3d middle = frame.origin + Vector3d(0.4, 0.4, 0.4);
  const std::vector<SurfaceSample> samples = {
      {frame.origin + Vector3d(0.22, 0.33, 0.41), Vector3d::UnitX(), middle},
      {frame.origin + Vector3d(0.24, 0.38, 0.31), Vector3d::UnitX(), middle},
      {frame.origin + Vector3d(0.25, 0.38, 0.31), -Vector3d::UnitX(), middle},
      {frame.origin + Vector3d(0.35, 0.38, 0.18), Vector3d::UnitZ(), middle},
      // A quarter of a metre away from any plane.
      {frame.origin + Vector3d(0.4, 0.4, 0.45), Vector3d::UnitZ(), middle}};
  const VoxelSurface surface(frame, OnePart(inside), samples);
  const BuildingModel model = surface.Model({{.floor_z = 0, .ceiling_z = 2}});
  ExpectWatertight(model);
  ASSERT_EQ(model.faces.size(), 6u);
  EXPECT_NEAR(EnclosedVolumes(model)[std::pair(0, 0)], 0.37 * 0.4 * 0.42, 1e-9);
  int num_walls = 0;
  for (const ModelFace& face : model.faces) {
    EXPECT_EQ(face.vertices.size(), 4u);
    num_walls += face.kind == SurfaceKind::kWall;
    if (face.kind != SurfaceKind::kFloor) continue;
    EXPECT_NEAR(face.vertices[0].z(), 0.68, 1e-9);
  }
  EXPECT_EQ(num_walls, 4);
  const MultiPolygon2 section = surface.Section(0.5 + 0.35, 0);
  ASSERT_EQ(section.size(), 1u);
  EXPECT_EQ(section[0].outer.size(), 4u);
  EXPECT_NEAR(Area(section), 0.37 * 0.4, 1e-9);
  EXPECT_TRUE(surface.Section(0.5, 0).empty());
  EXPECT_TRUE(surface.Section(100, 0).empty());
}

TEST(MakeVolumeProblem, CountsRaysAndWhatLiesBehindPoints) {
  const VoxelFrame frame = MakeFrame(8, 8, 8);
  const auto at = [&](double x, double y, double z) {
    return Vector3d(frame.origin + 0.1 * Vector3d(x, y, z));
  };
  // Two rays along x to a wall at x = 4.9 voxels; the second one comes from behind the first one's.
  const std::vector<SurfaceSample> samples = {
      {at(4.9, 2.5, 3.5), -Vector3d::UnitX(), at(1.5, 2.5, 3.5)},
      {at(6.2, 2.5, 3.5), -Vector3d::UnitX(), at(3.5, 2.5, 3.5)}};
  RunContext context(2);
  const GridCutProblem problem = MakeVolumeProblem(frame, samples, {.face = 77}, context);
  const auto index = [&](int x) { return problem.Index(2, x, 3); };
  EXPECT_EQ(problem.source_capacity[index(1)], kVoxelVote);
  EXPECT_EQ(problem.source_capacity[index(4)], kVoxelVote);
  EXPECT_EQ(problem.source_capacity[index(5)], kVoxelVote / 2);
  EXPECT_EQ(problem.sink_capacity[index(5)], kVoxelVote / 2);
  EXPECT_EQ(problem.sink_capacity[index(6)], kVoxelVote);
  EXPECT_EQ(problem.source_capacity[problem.Index(3, 4, 3)], 0);
  // The wall's face is between voxels 4 and 5.
  EXPECT_EQ(problem.east_capacity[index(4)], 0);
  EXPECT_EQ(problem.east_capacity[index(5)], 0);
  EXPECT_EQ(problem.east_capacity[index(3)], 77);
  EXPECT_EQ(problem.up_capacity[index(4)], 77);
  EXPECT_GT(problem.sink_capacity[problem.Index(0, 3, 3)], 1'000'000);
}

}  // namespace
}  // namespace enfilade
