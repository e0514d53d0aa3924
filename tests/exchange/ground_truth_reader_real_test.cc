// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/ground_truth_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "enfilade/exchange/scene_reader.h"
#include "enfilade/geometry/boolean.h"
#include "tests/support/real_data.h"

namespace enfilade {
namespace {

constexpr char kTour[] = "zind_sample_tour/000";

MultiPolygon2 UnionOfRooms(const GroundTruth& truth) {
  MultiPolygon2 all;
  for (const TruthRoom& room : truth.rooms) {
    all.insert(all.end(), room.region.begin(), room.region.end());
  }
  return Union(all);
}

double TotalLength(const std::vector<std::array<Eigen::Vector2d, 2>>& segments) {
  double length = 0;
  for (const auto& [a, b] : segments) length += (b - a).norm();
  return length;
}

TEST(GroundTruthReaderReal, TheTourHasTheRoomsAndAreasOfTheProtocol) {
  ENFILADE_REQUIRE_REAL_DATA(kTour);
  const GroundTruth truth = ReadGroundTruth(RealDataFolder() / kTour);
  EXPECT_EQ(truth.rooms.size(), 15U);
  EXPECT_EQ(truth.views.size(), 32U);
  const MultiPolygon2 net = UnionOfRooms(truth);
  EXPECT_NEAR(Area(net), 143.12, 0.01);
  EXPECT_NEAR(Area(CloseRegion(net, 0.3, 1.0)), 151.04, 0.05);
  EXPECT_EQ(std::count_if(truth.views.begin(), truth.views.end(),
                          [](const TruthView& view) { return !view.is_inside; }),
            6);
  for (const TruthRoom& room : truth.rooms) {
    EXPECT_EQ(room.region.size(), 1U);
    if (!room.ceiling_z) continue;
    EXPECT_THAT(*room.ceiling_z, testing::AllOf(testing::Gt(2.2), testing::Lt(2.65)));
  }
  EXPECT_EQ(truth.doors.size(), 18U);
  EXPECT_NEAR(TotalLength(truth.walls), 129.2, 0.1);  // of 166.3 m of outlines
}

TEST(GroundTruthReaderReal, TruthAndSceneShareNamesHashesAndPoses) {
  ENFILADE_REQUIRE_REAL_DATA(kTour);
  RunContext context;
  const Scene scene = ReadScene(RealDataFolder() / kTour, {}, context).scene;
  const GroundTruth truth = ReadGroundTruth(RealDataFolder() / kTour);
  for (const View& view : scene.views) {
    const auto it = std::find_if(truth.views.begin(), truth.views.end(),
                                 [&](const TruthView& t) { return t.sha256 == view.sha256; });
    ASSERT_NE(it, truth.views.end());
    EXPECT_EQ(it->picture, view.picture);
    EXPECT_EQ(it->world_from_cam->Matrix(), view.world_from_cam.Matrix());
    const bool is_contained =
        Contains(it->visible_layout, view.world_from_cam.translation.head<2>());
    EXPECT_TRUE(is_contained || !it->is_inside) << view.picture;
  }
}

TEST(GroundTruthReaderReal, TheRenderedRoomsAreOneRegionAroundTheirCameras) {
  ENFILADE_REQUIRE_REAL_DATA("pano3dlayout");
  for (const auto& folder :
       std::filesystem::directory_iterator(RealDataFolder() / "pano3dlayout")) {
    if (!folder.is_directory()) continue;
    SCOPED_TRACE(folder.path());
    const GroundTruth truth = ReadGroundTruth(folder.path());
    ASSERT_EQ(truth.rooms.size(), 1U);
    const TruthRoom& room = truth.rooms[0];
    EXPECT_EQ(room.region.size(), 1U);
    EXPECT_TRUE(room.region[0].holes.empty());
    EXPECT_TRUE(IsSimple(room.region[0].outer));
    EXPECT_TRUE(room.floor_z.has_value());
    EXPECT_FALSE(room.ceiling_z.has_value());
    for (const TruthView& view : truth.views) {
      EXPECT_TRUE(view.is_inside);
      EXPECT_THAT(view.camera_height_m, testing::AllOf(testing::Gt(0.7), testing::Lt(2.0)));
    }
  }
}

}  // namespace
}  // namespace enfilade
