// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/labels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/exchange/pixel_truth.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/image/codec.h"
#include "tests/evaluate/small_home.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

LabelFigures Judge(const SmallHome& home, std::vector<int> truth_idx = {0, 1, 2},
                   const LabelSource& maps = {}) {
  RunContext context(2);
  return EvaluateLabels(home.scene, home.structure, home.truth, truth_idx, maps, context);
}

// The twin: walks along the ray in small steps until it leaves the room.
SurfaceLabel SlowLabel(const WallProfile& profile, const Vector3d& camera, const Vector3d& ray) {
  const double azimuth = std::atan2(ray.y(), ray.x());
  int column = 0;
  for (int c = 1; c < profile.num_columns(); ++c) {
    const auto off = [&](int k) {
      return std::abs(WrapPi(AzimuthOfColumn(k, profile.num_columns()) - azimuth));
    };
    if (off(c) < off(column)) column = c;
  }
  for (double t = 0;; t += 1e-3) {
    const Vector3d p = camera + t * ray;
    if (p.z() < profile.floor_z) return SurfaceLabel::kFloor;
    if (p.z() > profile.ceiling_z) return SurfaceLabel::kCeiling;
    if (t * ray.head<2>().norm() > profile.wall_m[static_cast<size_t>(column)]) {
      return SurfaceLabel::kWall;
    }
  }
}

TEST(LabelsOfProfile, AgreesWithItsBruteForceTwin) {
  const SmallHome home = MakeSmallHome();
  const Rigid3 tilt{Eigen::AngleAxisd(0.1, Vector3d(1, 2, 0).normalized()).toRotationMatrix(),
                    Vector3d::Zero()};
  const Rigid3 home_from_cam =
      home.structure.home_from_world * home.scene.views[1].world_from_cam * tilt;
  const WallProfile& profile = home.structure.profiles[1];
  const ImageU8 labels = LabelsOfProfile(profile, home_from_cam, 32, 64);
  const Camera camera = EquirectangularCamera(64, 32);
  int num_differing = 0;
  for (int row = 0; row < 32; ++row) {
    for (int col = 0; col < 64; ++col) {
      const Vector3d ray = home_from_cam.rotation * camera.RayFromPixel({col + 0.5, row + 0.5});
      num_differing += labels(row, col) !=
                       static_cast<uint8_t>(SlowLabel(profile, home_from_cam.translation, ray));
    }
  }
  EXPECT_LE(num_differing, 2);  // the walk stops up to 1 mm late
}

TEST(EvaluateLabels, TruthAgainstItselfIsPerfect) {
  const TempFolder folder;
  SmallHome home = MakeSmallHome();
  WritePixelTruth(folder.path(), home);
  const LabelFigures figures = Judge(home);
  ASSERT_EQ(figures.panoramas.size(), 3u);
  EXPECT_GT(*figures.accuracy, 0.995);  // columns of 1° cut the corners
  EXPECT_GT(*figures.iou_mean, 0.99);
}

TEST(EvaluateLabels, CountsPixelsAndLeavesOutFurniture) {
  const TempFolder folder;
  SmallHome home = MakeSmallHome();
  home.truth.views[0].labels_path = folder / "a.png";
  const Rigid3 home_from_cam = home.structure.home_from_world * home.scene.views[0].world_from_cam;
  ImageU8 labels = LabelsOfProfile(home.structure.profiles[0], home_from_cam, 32, 64);
  // The lower half is floor and wall; its last row becomes furniture, the one before ceiling.
  for (int col = 0; col < 64; ++col) labels(31, col) = 0;
  for (int col = 0; col < 64; ++col) labels(30, col) = static_cast<uint8_t>(SurfaceLabel::kCeiling);
  WriteImage(folder / "a.png", labels);
  const LabelFigures figures = Judge(home, {0, -1, -1});
  ASSERT_EQ(figures.panoramas.size(), 1u);
  EXPECT_NEAR(*figures.accuracy, 30.0 / 31, 1e-12);
  int num_floor = 0, num_ceiling = 0;
  for (const uint8_t label : labels.data()) {
    num_floor += label == 1;
    num_ceiling += label == 3;
  }
  const double floor_iou = num_floor / (num_floor + 64.0);
  const double ceiling_iou = (num_ceiling - 64.0) / num_ceiling;
  EXPECT_NEAR(*figures.iou_mean, (floor_iou + 1 + ceiling_iou) / 3, 1e-12);
}

TEST(EvaluateLabels, ColumnsWithoutADistanceCountAsWrong) {
  const TempFolder folder;
  SmallHome home = MakeSmallHome();
  WritePixelTruth(folder.path(), home);
  for (WallProfile& profile : home.structure.profiles) {
    profile.wall_m.assign(360, std::numeric_limits<float>::quiet_NaN());
  }
  EXPECT_EQ(Judge(home).accuracy, 0.0);
}

TEST(EvaluateLabels, WithoutTrueLabelsTheLayoutIsProjected) {
  const TempFolder folder;
  SmallHome home = MakeSmallHome();
  EXPECT_GT(*Judge(home).accuracy, 0.99);
  EXPECT_EQ(Judge(home).superpixel_accuracy, std::nullopt);
  home.structure.profiles[0].ceiling_z += 0.5;
  EXPECT_LT(*Judge(home).panoramas[0].accuracy, 0.97);
  for (TruthRoom& room : home.truth.rooms) room.ceiling_z.reset();
  EXPECT_EQ(Judge(home).accuracy, std::nullopt);
  WritePixelTruth(folder.path(), home);
  EXPECT_EQ(Judge(home, {-1, -1, -1}).accuracy, std::nullopt);
  WriteFileAtomic(home.truth.views[1].labels_path, "broken");
  EXPECT_THROW((void)Judge(home), InvalidInputError);
}

TEST(EvaluateLabels, MapsAreJudgedStageByStage) {
  const TempFolder folder;
  SmallHome home = MakeSmallHome();
  WritePixelTruth(folder.path(), home);
  const auto maps = [&](int view_idx) -> std::optional<LabelMaps> {
    if (view_idx == 2) return std::nullopt;
    LabelMaps found;
    // Half of the rows, as at half the resolution, nothing yet, and all that is not furniture.
    const ImageU8 truth =
        ReadTruthLabels(home.truth.views[static_cast<size_t>(view_idx)].labels_path);
    found.final_labels = truth;
    found.after_points = ImageU8(truth.rows() / 2, truth.cols() / 2);
    found.after_free_space = truth;
    for (int r = 0; r < truth.rows() / 2; ++r)
      std::fill_n(found.after_free_space.row(r), truth.cols(), uint8_t{0});
    return found;
  };
  const LabelFigures figures = Judge(home, {0, 1, 2}, maps);
  EXPECT_EQ(figures.superpixel_accuracy, 1.0);
  EXPECT_EQ(figures.points_accuracy, 0.0);
  EXPECT_NEAR(*figures.free_space_accuracy, 0.5, 0.05);
  EXPECT_EQ(figures.panoramas[2].superpixel_accuracy, std::nullopt);
}

}  // namespace
}  // namespace enfilade
