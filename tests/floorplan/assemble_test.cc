// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/assemble.h"

#include <gtest/gtest.h>

#include "tests/floorplan/drawn_evidence.h"
#include "tests/support/floorplan_checks.h"

namespace enfilade {
namespace {

// A solved plan taken apart into polygons and assembled again is the same plan.
TEST(AssembleFloorplan, MakesOfPolygonsWhatTheSolverMakes) {
  Polygon2 room = Box(0, 0, 5, 4);
  room.holes = {ParseRing("2,2 2,2.6 2.6,2.6 2.6,2")};
  std::vector<EvidenceGrids> evidence = {
      DrawEvidence({room, Box(5.12, 0, 8, 4)}, {.face_blur_m = 0.03, .noise = 1}),
      DrawEvidence({Box(0, 0, 3, 3)})};
  EraseEvidence(Box(6, -1, 9, 0.5), evidence[0]);
  Scene scene;
  scene.views.resize(2);
  scene.views[0].world_from_cam.translation = {1, 1, 1.5};
  scene.views[1].world_from_cam.translation = {1, 1, 4.5};
  scene.views[1].storey_idx = 1;
  Structure structure;
  structure.storeys = {{.floor_z = 0, .ceiling_z = 2.4}, {.floor_z = 3, .ceiling_z = 5.4}};
  WallProfile profile;
  profile.floor_z = 0.02;
  profile.ceiling_z = 2.5;
  profile.ceiling_weight = 1;
  structure.profiles = {profile};
  RunContext context(1);
  const Floorplan solved = SolveFloorplan(scene, structure, evidence, {}, context).plan;
  std::vector<MultiPolygon2> polygons(2);
  for (size_t i = 0; i < 2; ++i) {
    for (const Room& solved_room : solved.storeys[i].rooms)
      polygons[i].push_back(solved_room.polygon);
  }
  ASSERT_EQ(polygons[0].size(), 2u);

  const Floorplan plan = AssembleFloorplan(scene, structure, evidence, polygons, {});
  ExpectValidFloorplan(plan);
  ASSERT_EQ(plan.cameras.size(), 2u);
  EXPECT_EQ(plan.cameras[1].storey_idx, 1);
  ASSERT_EQ(plan.storeys.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    const Storey &storey = plan.storeys[i], &expected = solved.storeys[i];
    EXPECT_EQ(storey.floor_z, expected.floor_z);
    ASSERT_EQ(storey.rooms.size(), expected.rooms.size());
    for (size_t k = 0; k < storey.rooms.size(); ++k) {
      EXPECT_EQ(storey.rooms[k].ceiling_z, expected.rooms[k].ceiling_z);
      EXPECT_EQ(storey.rooms[k].area_sigma_m2, expected.rooms[k].area_sigma_m2);
    }
    ASSERT_EQ(storey.walls.size(), expected.walls.size());
    for (size_t k = 0; k < storey.walls.size(); ++k) {
      EXPECT_EQ(storey.walls[k].seen, expected.walls[k].seen);
      EXPECT_EQ(storey.walls[k].sigma_m, expected.walls[k].sigma_m);
    }
  }
  for (const Room& assembled : plan.storeys[0].rooms)
    EXPECT_EQ(assembled.ceiling_z, Contains(assembled.polygon, {1, 1}) ? 2.5 : 2.4);
}

}  // namespace
}  // namespace enfilade
