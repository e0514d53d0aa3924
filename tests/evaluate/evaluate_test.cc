// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/evaluate.h"

#include <gtest/gtest.h>

#include "enfilade/base/errors.h"
#include "enfilade/evaluate/report.h"
#include "tests/evaluate/small_home.h"

namespace enfilade {
namespace {

EvaluationReport Judge(const EvaluationInput& input, const GroundTruth& truth) {
  RunContext context(1);
  return Evaluate(input, truth, {}, context);
}

// The hall is known, anywhere: a component on a storey of its own.
SmallHome MakeHomeWithHallApart() {
  SmallHome home = MakeSmallHome();
  Storey apart;
  apart.rooms.push_back(home.plan.storeys[0].rooms.back());
  home.plan.storeys[0].rooms.pop_back();
  home.plan.storeys.push_back(apart);
  home.plan.cameras[2].component_idx = home.scene.views[2].component_idx = 1;
  home.plan.cameras[2].storey_idx = home.scene.views[2].storey_idx = 1;
  return home;
}

TEST(Evaluate, JudgesTheLargestComponentAlone) {
  SmallHome home = MakeHomeWithHallApart();
  EvaluationInput input{&home.scene, nullptr, &home.plan};
  const EvaluationReport report = Judge(input, home.truth);
  ASSERT_TRUE(report.figures.at("area_iou_gross_largest"));
  EXPECT_NEAR(*report.figures.at("area_iou_net_largest"), 1, 1e-9);
  EXPECT_NEAR(*report.figures.at("area_iou_gross_largest"), 1, 1e-9);
}

// Room 1 has no camera and is in the plan: as right as with poses for all.
TEST(Evaluate, RoomsThatNobodyEnteredBelongToTheLargestComponent) {
  SmallHome home = MakeHomeWithHallApart();
  home.plan.cameras[1] = home.plan.cameras[0];
  home.scene.views[1].world_from_cam = home.scene.views[0].world_from_cam;
  home.truth.views[1].world_from_cam = home.truth.views[0].world_from_cam;
  const EvaluationReport report = Judge({&home.scene, nullptr, &home.plan}, home.truth);
  EXPECT_NEAR(report.figures.at("area_iou_gross_largest").value_or(0), 1, 1e-9);
}

TEST(Evaluate, TruthAgainstItselfIsPerfect) {
  const SmallHome home = MakeSmallHome();
  const EvaluationReport report = Judge({&home.scene, &home.structure, &home.plan}, home.truth);
  EXPECT_EQ(report.num_matched, 3);
  EXPECT_NEAR(*report.figures.at("area_iou_net"), 1, 1e-9);
  EXPECT_NEAR(*report.figures.at("area_iou_gross"), 1, 1e-9);
  EXPECT_NEAR(*report.figures.at("area_error_gross"), 0, 1e-9);
  EXPECT_NEAR(*report.figures.at("wall_plan_to_truth_p95_m"), 0, 1e-9);
  EXPECT_NEAR(*report.figures.at("wall_truth_to_plan_p95_m"), 0, 1e-9);
  EXPECT_EQ(report.figures.at("wall_within_10cm"), 1.0);
  EXPECT_EQ(report.figures.at("columns_within_5pct"), 1.0);
  EXPECT_NEAR(*report.figures.at("column_median_deg"), 0, 1e-4);
}

TEST(Evaluate, HasEveryKeyAndNoOther) {
  const SmallHome home = MakeSmallHome();
  const EvaluationReport report = Judge({&home.scene, &home.structure, &home.plan}, home.truth);
  EXPECT_EQ(report.figures.size(), FigureInfos().size());
}

TEST(Evaluate, WhatHasNotRunIsNone) {
  const SmallHome home = MakeSmallHome();
  const EvaluationReport only_plan = Judge({nullptr, nullptr, &home.plan}, home.truth);
  EXPECT_EQ(only_plan.figures.at("column_median_deg"), std::nullopt);
  EXPECT_TRUE(only_plan.figures.at("area_iou_net"));
  const EvaluationReport only_structure =
      Judge({&home.scene, &home.structure, nullptr}, home.truth);
  EXPECT_TRUE(only_structure.figures.at("column_median_deg"));
  EXPECT_EQ(only_structure.figures.at("area_iou_net"), std::nullopt);
  for (const auto& [key, value] : Judge({}, home.truth).figures)
    EXPECT_EQ(value, std::nullopt) << key;
}

TEST(Evaluate, RefusesTheTruthOfAnotherHome) {
  SmallHome home = MakeSmallHome();
  for (TruthView& view : home.truth.views) {
    view.picture = "other_" + view.picture;
    view.sha256 = "";
  }
  EXPECT_THROW((void)Judge({&home.scene, &home.structure, nullptr}, home.truth), InvalidInputError);
  EXPECT_THROW((void)Judge({nullptr, nullptr, &home.plan}, home.truth), InvalidInputError);
  home.truth.views[2].picture = home.scene.views[2].picture;  // one is enough
  EXPECT_EQ(Judge({&home.scene, &home.structure, nullptr}, home.truth).num_matched, 1);
}

// As when a made home was made again with another seed.
TEST(Evaluate, SaysWhenOnlyTheNamesOfPicturesAgree) {
  SmallHome home = MakeSmallHome();
  home.scene.views[0].sha256 = home.truth.views[0].sha256 = "a";
  home.scene.views[1].sha256 = home.truth.views[1].sha256 = "";
  home.scene.views[2].sha256 = "b";
  home.truth.views[2].sha256 = "c";
  const EvaluationReport report = Judge({&home.scene, &home.structure, nullptr}, home.truth);
  EXPECT_EQ(report.num_matched, static_cast<int>(home.scene.views.size()));
  EXPECT_EQ(report.num_changed, 1);
}

TEST(Evaluate, ATruthWithoutPicturesJudgesThePlan) {
  SmallHome home = MakeSmallHome();
  home.truth.views.clear();
  const EvaluationReport report = Judge({&home.scene, &home.structure, &home.plan}, home.truth);
  EXPECT_NEAR(*report.figures.at("area_iou_net"), 1, 1e-9);
  EXPECT_EQ(report.figures.at("column_median_deg"), std::nullopt);
}

TEST(Evaluate, ATruthWithoutRoomsJudgesTheColumns) {
  SmallHome home = MakeSmallHome();
  home.truth.rooms.clear();
  home.truth.walls.clear();
  const EvaluationReport report = Judge({&home.scene, &home.structure, &home.plan}, home.truth);
  EXPECT_EQ(report.figures.at("area_iou_net"), std::nullopt);
  EXPECT_EQ(report.figures.at("wall_within_10cm"), std::nullopt);
  EXPECT_EQ(report.figures.at("columns_within_5pct"), 1.0);
}

}  // namespace
}  // namespace enfilade
