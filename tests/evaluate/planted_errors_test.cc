// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0

// Every figure on a result without errors, and with one planted error at a time: what that error
// must move moves by the amount that follows from geometry, and all other figures stay.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>

#include "enfilade/evaluate/evaluate.h"
#include "enfilade/evaluate/report.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/model/extrude.h"
#include "tests/evaluate/small_home.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kNet_m2 = 4 * 3 + 4 * 3 + 8.1 * 1.5;
constexpr double kGross_m2 = 8.1 * 4.6;
constexpr double kWalls_m = 14 + 14 + 19.2 - 4 * 0.9;  // both faces of both doors are left out

struct Value {
  double value;
  double tolerance = 1e-6;
};

// Figures that must have a value, or may have any (null).
using Expected = std::map<std::string, std::optional<Value>>;

class PlantedErrors : public testing::Test {
 protected:
  PlantedErrors() { WritePixelTruth(folder_.path(), home_); }

  [[nodiscard]] MetricReport Judge() const {
    RunContext context(2);
    const BuildingModel model = ExtrudeFloorplan(home_.plan);
    return Evaluate({.scene = &home_.scene,
                     .structure = &home_.structure,
                     .floorplan = &home_.plan,
                     .model = &model},
                    home_.truth, {}, context)
        .figures;
  }

  void SetPlan(const std::vector<Ring2>& rooms, const std::vector<Opening>& openings) {
    home_.plan = MakePlan(rooms, openings);
  }

  // Judges the home as the test left it against what `before` found.
  void ExpectMoved(const MetricReport& before, const Expected& moved) const {
    const MetricReport after = Judge();
    for (const FigureInfo& info : FigureInfos()) {
      const std::string key(info.key);
      SCOPED_TRACE(key);
      const auto expected = moved.find(key);
      if (expected == moved.end()) {
        ASSERT_EQ(after.at(key).has_value(), before.at(key).has_value());
        if (after.at(key)) {
          EXPECT_NEAR(*after.at(key), *before.at(key), 1e-6);
        }
      } else if (expected->second) {
        ASSERT_TRUE(after.at(key));
        EXPECT_NEAR(*after.at(key), expected->second->value, expected->second->tolerance);
      }
    }
  }

  SmallHome home_ = MakeSmallHome();

 private:
  TempFolder folder_;
};

TEST_F(PlantedErrors, WithoutAnyEveryFigureIsPerfect) {
  const Expected perfect = {
      {"area_iou_net", Value{1}},
      {"area_iou_gross", Value{1}},
      {"area_iou_net_largest", std::nullopt},  // one component
      {"area_iou_gross_largest", std::nullopt},
      {"area_error_gross", Value{0}},
      {"area_net_m2", Value{kNet_m2}},
      {"area_gross_m2", Value{kGross_m2, 0.01}},
      {"truth_area_net_m2", Value{kNet_m2}},
      {"truth_area_gross_m2", Value{kGross_m2, 0.01}},
      {"wall_plan_to_truth_median_m", Value{0}},
      {"wall_plan_to_truth_p95_m", Value{0}},
      {"wall_truth_to_plan_median_m", Value{0}},
      {"wall_truth_to_plan_p95_m", Value{0}},
      {"wall_within_10cm", Value{1}},
      {"column_median_deg", Value{0, 1e-4}},
      {"columns_within_5pct", Value{1}},
      {"columns_within_10pct", Value{1}},
      {"panorama_iou_median", Value{1, 0.002}},  // 360 columns cut the corners
      {"panoramas_judged", Value{3}},
      {"ceiling_median_m", Value{0}},
      {"panorama_ceiling_median_m", Value{0}},
      {"rooms_total", Value{3}},
      {"rooms_iou50", Value{3}},
      {"rooms_iou70", Value{3}},
      {"rooms_iou90", Value{3}},
      {"rooms_split", Value{0}},
      {"rooms_merged", Value{0}},
      {"rooms_false", Value{0}},
      {"room_f1_10cm", Value{1}},
      {"corner_f1_10cm", Value{1}},
      {"room_f1", Value{1}},
      {"corner_f1", Value{1}},
      {"angle_f1", Value{1}},
      {"door_precision", Value{1}},
      {"door_recall", Value{1}},
      {"door_graph_precision", Value{1}},
      {"door_graph_recall", Value{1}},
      {"pose_total", Value{3}},
      {"pose_registered", Value{3}},
      {"pose_inferred", Value{0}},
      {"pose_components", Value{1}},
      {"pose_median_m", Value{0}},
      {"pose_max_m", Value{0}},
      {"pose_yaw_median_deg", Value{0}},
      {"pose_tilt_median_deg", Value{0}},
      {"pose_scale_error", Value{0}},
      {"label_accuracy", Value{1, 0.005}},  // 360 columns
      {"label_iou_mean", Value{1, 0.01}},
      {"label_accuracy_points", std::nullopt},
      {"label_accuracy_free_space", std::nullopt},
      {"label_accuracy_superpixels", std::nullopt},
      {"sigma1_coverage", Value{1}},
      {"sigma2_coverage", Value{1}},
      {"sigma1_coverage_seen", Value{1}},
      {"sigma2_coverage_seen", Value{1}},
      {"sigma1_coverage_partly", Value{1}},
      {"sigma2_coverage_partly", Value{1}},
      {"sigma1_coverage_inferred", Value{1}},
      {"sigma2_coverage_inferred", Value{1}},
      {"model_hit_share", Value{1}},
      {"depth_median_m", Value{0}},
      {"depth_within_5pct", Value{1}},
      {"normal_median_deg", Value{0, 1e-3}},
      {"self_score", std::nullopt},
      {"seconds", std::nullopt},
      {"peak_memory_mb", std::nullopt},
  };
  EXPECT_EQ(perfect.size(), FigureInfos().size());
  ExpectMoved({}, perfect);
}

TEST_F(PlantedErrors, AWallMovedBy7Centimetres) {
  const MetricReport before = Judge();
  std::vector<Ring2> rooms = SmallHomeRooms();
  rooms[1] = ParseRing("4.1,0 8.17,0 8.17,3 4.1,3");
  SetPlan(rooms, SmallHomeDoors());
  const double swept_m2 = 0.07 * 3;
  ExpectMoved(before, {{"area_iou_net", Value{kNet_m2 / (kNet_m2 + swept_m2)}},
                       {"area_iou_gross", Value{kGross_m2 / (kGross_m2 + swept_m2), 3e-4}},
                       {"area_error_gross", Value{swept_m2 / kGross_m2, 3e-4}},
                       {"area_net_m2", Value{kNet_m2 + swept_m2}},
                       {"area_gross_m2", Value{kGross_m2 + swept_m2, 0.02}},
                       {"wall_plan_to_truth_p95_m", Value{0.07}},  // 3 m of 44 m
                       {"wall_truth_to_plan_p95_m", Value{0.07}},
                       {"sigma1_coverage", Value{11.0 / 12}},  // the wall is known to 2 cm
                       {"sigma2_coverage", Value{11.0 / 12}},
                       {"sigma1_coverage_inferred", Value{3.0 / 4}},
                       {"sigma2_coverage_inferred", Value{3.0 / 4}}});
}

TEST_F(PlantedErrors, TwoRoomsMerged) {
  const MetricReport before = Judge();
  std::vector<Opening> doors = SmallHomeDoors();
  for (Opening& door : doors) door.room_id = 0, door.other_room_id = 1;
  SetPlan({ParseRing("0,0 8.1,0 8.1,3 0,3"), SmallHomeRooms()[2]}, doors);
  home_.plan.storeys[0].rooms[1].ceiling_z = 2.6;
  const double merged_m2 = 8.1 * 3, hall_m2 = 8.1 * 1.5;
  ExpectMoved(before, {{"area_iou_net", Value{kNet_m2 / (merged_m2 + hall_m2)}},
                       {"area_iou_gross", Value{1, 1e-3}},
                       {"area_error_gross", Value{0, 1e-3}},
                       {"area_net_m2", Value{merged_m2 + hall_m2}},
                       {"area_gross_m2", Value{kGross_m2, 0.01}},
                       {"wall_truth_to_plan_p95_m", std::nullopt},  // up to half of 3 m
                       {"wall_within_10cm", Value{1 - 6 / kWalls_m, 5e-3}},
                       {"rooms_iou50", Value{1}},
                       {"rooms_iou70", Value{1}},
                       {"rooms_iou90", Value{1}},
                       {"rooms_merged", Value{1}},
                       {"room_f1_10cm", Value{2.0 / 5}},
                       {"corner_f1_10cm", Value{16.0 / 20}},
                       {"room_f1", Value{2.0 / 5}},
                       {"corner_f1", std::nullopt},
                       {"angle_f1", std::nullopt},
                       {"door_graph_recall", Value{1.0 / 2}},
                       {"depth_within_5pct", std::nullopt},  // seen by two of three panoramas
                       {"depth_median_m", std::nullopt}});
}

TEST_F(PlantedErrors, ADoorLost) {
  const MetricReport before = Judge();
  SetPlan(SmallHomeRooms(), {SmallHomeDoors()[0]});
  // What the model closes is closed in truth.
  ExpectMoved(before, {{"door_recall", Value{1.0 / 2}}, {"door_graph_recall", Value{1.0 / 2}}});
}

TEST_F(PlantedErrors, APlanTurnedByOneDegree) {
  const MetricReport before = Judge();
  home_.plan.home_from_world =
      home_.plan.home_from_world * Rigid3{RotationZ(DegToRad(-1)), Vector3d::Zero()};
  // About the origin: the far end of the hall moves by 8.1 m · sin 1°.
  ExpectMoved(before, {{"area_iou_net", Value{0.95, 0.03}},
                       {"area_iou_gross", Value{0.96, 0.03}},
                       {"area_error_gross", Value{0.04, 0.03}},
                       {"area_gross_m2", Value{kGross_m2, 0.01}},
                       {"wall_plan_to_truth_median_m", Value{0.06, 0.02}},
                       {"wall_plan_to_truth_p95_m", Value{0.14, 0.02}},
                       {"wall_truth_to_plan_median_m", Value{0.06, 0.02}},
                       {"wall_truth_to_plan_p95_m", Value{0.14, 0.02}},
                       {"wall_within_10cm", Value{0.7, 0.2}},
                       // The hall is 1.5 m deep and moves by 7 cm on average: IoU 0.896.
                       {"rooms_iou90", Value{2}},
                       {"room_f1_10cm", std::nullopt},
                       {"corner_f1_10cm", std::nullopt},
                       {"sigma1_coverage", std::nullopt},
                       {"sigma2_coverage", std::nullopt},
                       {"sigma1_coverage_seen", std::nullopt},
                       {"sigma2_coverage_seen", std::nullopt},
                       {"sigma1_coverage_partly", std::nullopt},
                       {"sigma2_coverage_partly", std::nullopt},
                       {"sigma1_coverage_inferred", std::nullopt},
                       {"sigma2_coverage_inferred", std::nullopt},
                       {"depth_median_m", Value{0, 0.05}},
                       {"depth_within_5pct", Value{0.8, 0.2}},
                       {"normal_median_deg", Value{0.5, 0.51}}});  // floors and ceilings stay
}

TEST_F(PlantedErrors, AMirroredPlan) {
  const MetricReport before = Judge();
  std::vector<Ring2> rooms = SmallHomeRooms();
  std::vector<Opening> doors = SmallHomeDoors();
  for (Ring2& room : rooms) {
    for (Vector2d& p : room) p.x() = 8.1 - p.x();
    std::reverse(room.begin(), room.end());
  }
  for (Opening& door : doors) {
    std::swap(door.a, door.b);
    door.a.x() = 8.1 - door.a.x();
    door.b.x() = 8.1 - door.b.x();
  }
  SetPlan(rooms, doors);
  // The home is symmetric about x = 4.05 but for its ceilings (two rooms change places) and for its
  // doors, which lie 20 cm from where they should: of either face of either door 20 cm are too much
  // wall, half of it within 10 cm, and 20 cm are missing.
  ExpectMoved(before, {{"wall_within_10cm", Value{1 - 0.4 / kWalls_m, 2e-3}},
                       {"ceiling_median_m", Value{0.1}},
                       {"depth_median_m", Value{0, 1e-5}},
                       {"depth_within_5pct", std::nullopt}});
}

TEST_F(PlantedErrors, CeilingsOfTheProfilesTooHigh) {
  const MetricReport before = Judge();
  for (WallProfile& profile : home_.structure.profiles) profile.ceiling_z += 0.2;
  ExpectMoved(before, {{"panorama_ceiling_median_m", Value{0.2}},
                       {"label_accuracy", Value{0.95, 0.04}},
                       {"label_iou_mean", Value{0.9, 0.08}}});
}

TEST_F(PlantedErrors, DistancesOfTheProfilesTooFar) {
  const MetricReport before = Judge();
  for (WallProfile& profile : home_.structure.profiles) {
    for (float& distance : profile.wall_m) distance *= 1.07F;
  }
  ExpectMoved(before, {{"column_median_deg", Value{1.7, 0.5}},
                       {"columns_within_5pct", Value{0}},
                       {"panorama_iou_median", Value{1 / (1.07 * 1.07), 0.002}},
                       {"label_accuracy", Value{0.97, 0.03}},
                       {"label_iou_mean", Value{0.95, 0.05}}});
}

TEST_F(PlantedErrors, ACameraOutOfPlace) {
  const MetricReport before = Judge();
  home_.scene.views[0].world_from_cam.translation.x() += 0.2;
  ExpectMoved(before, {{"pose_max_m", Value{0.2}}, {"pose_scale_error", std::nullopt}});
}

TEST_F(PlantedErrors, AWorldOfEstimatedPosesIsBroughtToTheTruths) {
  const MetricReport before = Judge();
  const Rigid3 motion{RotationZ(1.9), Vector3d(7, -20, 3)};
  for (View& view : home_.scene.views) view.world_from_cam = motion * view.world_from_cam;
  for (PlanCamera& camera : home_.plan.cameras) {
    camera.world_from_cam = motion * camera.world_from_cam;
  }
  home_.structure.home_from_world = home_.structure.home_from_world * motion.Inverse();
  home_.plan.home_from_world = home_.plan.home_from_world * motion.Inverse();
  home_.scene.pose_source = PoseSource::kEstimated;
  ExpectMoved(before, {});
  home_.scene.pose_source = PoseSource::kTransforms;  // given poses are never fitted
  EXPECT_EQ(Judge().at("area_iou_net"), 0.0);
}

}  // namespace
}  // namespace enfilade
