// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/poses.h"

#include <gtest/gtest.h>

#include <random>

#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

// A tour of cameras and its truth: the same, but for what a test does to the cameras.
struct Tour {
  std::vector<JudgedCamera> cameras;
  GroundTruth truth;
  std::vector<int> truth_idx;

  explicit Tour(int num_cameras) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> place(0, 12);
    for (int i = 0; i < num_cameras; ++i) {
      TruthView view;
      view.world_from_cam =
          Rigid3{RotationZ(place(random)), Vector3d(place(random), place(random), 1.4)};
      cameras.push_back({*view.world_from_cam, 0, false});
      truth.views.push_back(view);
      truth_idx.push_back(i);
    }
  }

  void Move(const Rigid3& motion, size_t first = 0) {
    for (size_t i = first; i < cameras.size(); ++i) {
      cameras[i].world_from_cam = motion * cameras[i].world_from_cam;
    }
  }
  // As evaluate does with poses that were estimated.
  [[nodiscard]] PoseFigures Judge() {
    Move(FitTruthFromWorld(cameras, truth, truth_idx));
    return EvaluatePoses(cameras, truth, truth_idx).value();
  }
};

const Rigid3 kMotion{RotationZ(2.2), Vector3d(5, -3, 0.7)};

TEST(FitTruthFromWorld, UndoesAMotionInThePlanAndInHeight) {
  Tour tour(7);
  tour.Move(kMotion);
  const PoseFigures figures = tour.Judge();
  EXPECT_EQ(figures.total, 7);
  EXPECT_EQ(figures.registered, 7);
  EXPECT_EQ(figures.inferred, 0);
  EXPECT_EQ(figures.components, 1);
  EXPECT_NEAR(*figures.median_m, 0, 1e-9);
  EXPECT_NEAR(*figures.max_m, 0, 1e-9);
  EXPECT_NEAR(*figures.yaw_median_rad, 0, 1e-9);
  EXPECT_NEAR(*figures.tilt_median_rad, 0, 1e-9);
  EXPECT_NEAR(*figures.scale_error, 0, 1e-9);
}

TEST(FitTruthFromWorld, ALostCameraMovesNoOther) {
  Tour tour(7);
  tour.Move(kMotion);
  tour.cameras[2].world_from_cam.translation += Vector3d(3, 1, 0);
  const PoseFigures figures = tour.Judge();
  EXPECT_EQ(figures.registered, 6);
  EXPECT_NEAR(*figures.max_m, 0, 1e-9);
  EXPECT_FALSE(figures.errors[2].is_registered);
  EXPECT_NEAR(figures.errors[2].distance_m, std::hypot(3, 1), 1e-9);
}

TEST(FitTruthFromWorld, AnotherScaleIsToldAndNotFitted) {
  Tour tour(8);
  for (JudgedCamera& camera : tour.cameras) camera.world_from_cam.translation *= 1.02;
  tour.Move(kMotion);
  const PoseFigures figures = tour.Judge();
  EXPECT_NEAR(*figures.scale_error, 1 - 1 / 1.02, 1e-6);
  EXPECT_GT(*figures.median_m, 0.02);
  EXPECT_EQ(figures.registered, 8);
}

TEST(FitTruthFromWorld, CamerasInOnePlaceAreTurnedByTheirRotations) {
  Tour tour(2);
  for (size_t i = 0; i < 2; ++i) {
    tour.truth.views[i].world_from_cam->translation = Vector3d(1, 2, 1.5);
    tour.cameras[i].world_from_cam = *tour.truth.views[i].world_from_cam;
  }
  tour.Move(kMotion);
  const PoseFigures figures = tour.Judge();
  EXPECT_EQ(figures.registered, 2);
  EXPECT_NEAR(*figures.max_m, 0, 1e-9);
  EXPECT_EQ(figures.scale_error, std::nullopt);
}

TEST(FitTruthFromWorld, LooksAtTheLargestComponentAlone) {
  Tour tour(9);
  tour.Move({RotationZ(1), Vector3d(40, 0, 0)}, 5);  // 5 … 8 are a component of their own
  for (size_t i = 5; i < 9; ++i) tour.cameras[i].component_idx = 1;
  tour.cameras[0].is_inferred = true;  // no evidence: 4 against 4, the first component wins
  tour.cameras[0].world_from_cam.translation.x() += 0.3;
  const PoseFigures figures = tour.Judge();
  EXPECT_EQ(figures.registered, 4);
  EXPECT_EQ(figures.inferred, 1);
  EXPECT_EQ(figures.components, 2);
  EXPECT_NEAR(*figures.max_m, 0, 1e-9);
  EXPECT_NEAR(figures.errors[0].distance_m, 0.3, 1e-9);
}

TEST(EvaluatePoses, TellsYawFromTilt) {
  Tour tour(5);
  for (JudgedCamera& camera : tour.cameras) {
    camera.world_from_cam.rotation = RotationZ(DegToRad(2)) *
                                     AngleAxisd(DegToRad(1), Vector3d::UnitX()) *
                                     camera.world_from_cam.rotation;
  }
  const PoseFigures figures = EvaluatePoses(tour.cameras, tour.truth, tour.truth_idx).value();
  EXPECT_NEAR(*figures.yaw_median_rad, DegToRad(2), 1e-9);
  EXPECT_NEAR(*figures.tilt_median_rad, DegToRad(1), 1e-9);
  EXPECT_EQ(figures.registered, 5);
}

TEST(EvaluatePoses, RegisteredIsWithinHalfAMetreAndFiveDegrees) {
  Tour tour(4);
  tour.cameras[0].world_from_cam.translation.z() += 0.49;
  tour.cameras[1].world_from_cam.translation.z() += 0.51;
  tour.cameras[2].world_from_cam.rotation =
      RotationZ(DegToRad(4.9)) * tour.cameras[2].world_from_cam.rotation;
  tour.cameras[3].world_from_cam.rotation =
      RotationZ(DegToRad(5.1)) * tour.cameras[3].world_from_cam.rotation;
  const PoseFigures figures = EvaluatePoses(tour.cameras, tour.truth, tour.truth_idx).value();
  EXPECT_EQ(figures.registered, 2);
  EXPECT_NEAR(*figures.max_m, 0.49, 1e-9);
}

TEST(EvaluatePoses, CountsWhatWasNotRegisteredAtAll) {
  Tour tour(5);
  tour.cameras.pop_back();
  tour.truth_idx = {0, 1, 2, -1};
  const PoseFigures figures = EvaluatePoses(tour.cameras, tour.truth, tour.truth_idx).value();
  EXPECT_EQ(figures.total, 5);
  EXPECT_EQ(figures.registered, 3);
  for (TruthView& view : tour.truth.views) view.world_from_cam.reset();
  EXPECT_FALSE(EvaluatePoses(tour.cameras, tour.truth, tour.truth_idx));
  EXPECT_TRUE(FitTruthFromWorld(tour.cameras, tour.truth, tour.truth_idx).Matrix().isIdentity(0));
}

}  // namespace
}  // namespace enfilade
