// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "enfilade/evaluate/evaluate.h"
#include "enfilade/exchange/ground_truth_reader.h"
#include "enfilade/exchange/scene_reader.h"
#include "tests/support/real_data.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
constexpr int kNumColumns = 1024;
constexpr const char* kTour = "zind_sample_tour/000";

GroundTruth TourTruth() { return ReadGroundTruth(RealDataFolder() / kTour); }

// The true rooms as a plan, every room of one part by itself, doors and all.
Floorplan PlanOfTruth(const GroundTruth& truth) {
  Floorplan plan;
  Storey storey;
  for (const TruthRoom& true_room : truth.rooms) {
    Room room;
    room.id = static_cast<int>(storey.rooms.size());
    room.polygon = true_room.region.front();
    room.floor_z = true_room.floor_z.value_or(0);
    room.ceiling_z = true_room.ceiling_z.value_or(2.4);
    storey.rooms.push_back(room);
  }
  for (const auto& door : truth.doors) {
    Opening opening;
    opening.id = static_cast<int>(storey.openings.size());
    opening.a = door[0];
    opening.b = door[1];
    storey.openings.push_back(opening);
  }
  plan.storeys.push_back(storey);
  return plan;
}

Structure StructureOfTruth(const Scene& scene, const GroundTruth& truth) {
  Structure structure;
  const std::vector<TruthView>& views = truth.views;
  for (size_t v = 0; v < scene.views.size(); ++v) {
    WallProfile profile;
    profile.view_idx = static_cast<int>(v);
    profile.wall_m.assign(kNumColumns, 1.0F);
    profile.is_seen.assign(kNumColumns, 1);
    for (const TruthView& view : views) {
      if (view.sha256 != scene.views[v].sha256) continue;
      for (int c = 0; c < kNumColumns; ++c) {
        const double azimuth = AzimuthOfColumn(c, kNumColumns);
        profile.wall_m[static_cast<size_t>(c)] = static_cast<float>(
            RayDistance(view.visible_layout, view.world_from_cam->translation.head<2>(),
                        Vector2d(std::cos(azimuth), std::sin(azimuth))));
      }
    }
    structure.profiles.push_back(profile);
  }
  return structure;
}

TEST(ZindTour, TrueRegionsHaveTheAreasOfTheProtocol) {
  ENFILADE_REQUIRE_REAL_DATA(kTour);
  const GroundTruth truth = TourTruth();
  const Floorplan plan = PlanOfTruth(truth);
  RunContext context(1);
  const MetricReport figures = Evaluate({nullptr, nullptr, &plan}, truth, {}, context).figures;
  // 144.0 and 151.3 when counted in cells of 1 cm with those on the border.
  EXPECT_NEAR(*figures.at("truth_area_net_m2"), 143.12, 0.01);
  EXPECT_NEAR(*figures.at("truth_area_gross_m2"), 151.04, 0.05);
  EXPECT_EQ(figures.at("rooms_total"), 15.0);
}

TEST(ZindTour, TruthAgainstItselfIsPerfect) {
  ENFILADE_REQUIRE_REAL_DATA(kTour);
  const GroundTruth truth = TourTruth();
  RunContext context;
  const Scene scene = ReadScene(RealDataFolder() / kTour, {}, context).scene;
  const Floorplan plan = PlanOfTruth(truth);
  const Structure structure = StructureOfTruth(scene, truth);
  const EvaluationReport report = Evaluate({&scene, &structure, &plan}, truth, {}, context);
  EXPECT_EQ(report.num_matched, 32);
  const MetricReport& figures = report.figures;
  EXPECT_NEAR(*figures.at("area_iou_net"), 1, 1e-6);
  EXPECT_NEAR(*figures.at("area_iou_gross"), 1, 1e-6);
  EXPECT_EQ(figures.at("rooms_iou90"), 15.0);
  EXPECT_EQ(figures.at("room_f1_10cm"), 1.0);
  EXPECT_EQ(figures.at("corner_f1_10cm"), 1.0);
  EXPECT_NEAR(*figures.at("wall_truth_to_plan_p95_m"), 0, 1e-6);
  EXPECT_NEAR(*figures.at("wall_plan_to_truth_p95_m"), 0, 1e-6);
  // The two faces of a door differ by centimetres; it is cut out of the plan as one.
  EXPECT_GT(*figures.at("wall_within_10cm"), 0.995);
  EXPECT_EQ(figures.at("door_recall"), 1.0);
  EXPECT_EQ(figures.at("panoramas_judged"), 26.0);
  EXPECT_NEAR(*figures.at("column_median_deg"), 0, 1e-4);
  EXPECT_EQ(figures.at("columns_within_5pct"), 1.0);
  EXPECT_GT(*figures.at("panorama_iou_median"), 0.995);
  for (const PanoramaFigures& panorama : report.columns.panoramas) {
    EXPECT_GT(panorama.num_columns, kNumColumns / 4) << panorama.picture;
  }
}

TEST(RenderedRooms, TruthAgainstItselfIsPerfect) {
  ENFILADE_REQUIRE_REAL_DATA("pano3dlayout");
  int num_rooms = 0;
  for (const auto& entry : std::filesystem::directory_iterator(RealDataFolder() / "pano3dlayout")) {
    if (!std::filesystem::exists(entry.path() / "layout.obj")) continue;
    SCOPED_TRACE(entry.path().filename().native());
    const GroundTruth truth = ReadGroundTruth(entry.path());
    RunContext context;
    const Scene scene = ReadScene(entry.path(), {}, context).scene;
    const Structure structure = StructureOfTruth(scene, truth);
    const Floorplan plan = PlanOfTruth(truth);
    const EvaluationReport report = Evaluate({&scene, &structure, &plan}, truth, {}, context);
    EXPECT_NEAR(*report.figures.at("area_iou_net"), 1, 1e-6);
    EXPECT_NEAR(*report.figures.at("wall_truth_to_plan_p95_m"), 0, 1e-6);
    EXPECT_EQ(report.num_matched, static_cast<int>(scene.views.size()));
    EXPECT_NEAR(*report.figures.at("column_median_deg"), 0, 1e-3);
    ++num_rooms;
  }
  EXPECT_EQ(num_rooms, 7);
}

}  // namespace
}  // namespace enfilade
