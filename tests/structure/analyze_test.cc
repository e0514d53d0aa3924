// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/analyze.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "enfilade/base/errors.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/image/codec.h"
#include "enfilade/synthetic/fixtures.h"
#include "enfilade/synthetic/render.h"
#include "enfilade/synthetic/text_home.h"
#include "enfilade/synthetic/truth.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kFloorZ = -0.2, kHeight = 2.55, kHeadingDeg = 17;

// One room with a bay, a window and three panoramas: a rendered picture of every stage's input.
class AnalyzeRoom : public ::testing::Test {
 protected:
  AnalyzeRoom() : home_(MakeRoom()), scene_(FixtureScene(home_, kSize.width, kSize.height)) {
    RunContext context(2);
    RenderOptions options;
    options.gather_rays = 48;
    options.light_cell_m = 0.1;
    const HomeRenderer renderer(home_, options, context);
    for (size_t i = 0; i < scene_.views.size(); ++i) {
      View& view = scene_.views[i];
      view.path = folder_ / (std::to_string(i) + ".png");
      WriteImage(view.path, renderer.Render(static_cast<int>(i), kSize, context).rgb);
    }
  }

  static Home MakeRoom() {
    TextHomeOptions options;
    options.height_m = kHeight;
    options.camera_height_m = 1.5;
    options.floor_z = kFloorZ;
    options.heading_rad = DegToRad(kHeadingDeg);
    options.baseboard_m = 0.07;
    return TextHome(
        "room 0,0 4.6,0 4.6,2.2 5.4,2.2 5.4,3.8 0,3.8 | window 1,0 2.2,0 "
        "| camera 1.4,1.5 | camera 3.2,2.4 | camera 2.2,2.9",
        options);
  }

  StructureReport Analyze(const StructureOptions& options, int num_threads = 2) const {
    RunContext context(num_threads);
    return AnalyzeStructure(scene_, options, context);
  }

  static StructureOptions Coarse() {
    StructureOptions options;
    options.num_columns = 256;
    options.max_width = 512;
    options.max_distance_m = 10;
    return options;
  }

  // Share of all columns whose wall is right within a share of its distance.
  double ColumnsWithin(const Structure& structure, double tolerance) const {
    const PlanSegments segments = MakePlanSegments(home_);
    int num_right = 0, total = 0;
    for (const WallProfile& profile : structure.profiles) {
      const Vector2d position =
          home_.cameras[static_cast<size_t>(profile.view_idx)].home_from_cam.translation.head<2>();
      for (int c = 0; c < profile.num_columns(); ++c) {
        const double azimuth = AzimuthOfColumn(c, profile.num_columns());
        const auto hit =
            CastPlanRay(segments.walls, position, {std::cos(azimuth), std::sin(azimuth)});
        const double wall_m = profile.wall_m[static_cast<size_t>(c)];
        num_right += hit && std::abs(wall_m / hit->distance_m - 1) <= tolerance;
        ++total;
      }
    }
    return static_cast<double>(num_right) / total;
  }

  static constexpr ImageSize kSize{1024, 512};
  TempFolder folder_;
  Home home_;
  Scene scene_;
};

void ExpectValid(const Structure& structure, size_t num_views, int num_columns) {
  ASSERT_EQ(structure.profiles.size(), num_views);
  EXPECT_TRUE(std::is_sorted(structure.bin_m.begin(), structure.bin_m.end()));
  for (size_t i = 0; i < num_views; ++i) {
    const WallProfile& profile = structure.profiles[i];
    EXPECT_EQ(profile.view_idx, static_cast<int>(i));
    EXPECT_LT(profile.floor_z, profile.ceiling_z);
    ASSERT_EQ(profile.num_columns(), num_columns);
    ASSERT_EQ(profile.obstacle_m.size(), profile.wall_m.size());
    ASSERT_EQ(profile.confidence.size(), profile.wall_m.size());
    ASSERT_EQ(profile.is_seen.size(), profile.wall_m.size());
    ASSERT_EQ(profile.wall_probability.rows(), num_columns);
    ASSERT_EQ(profile.wall_probability.cols(), static_cast<int>(structure.bin_m.size()));
    for (int c = 0; c < num_columns; ++c) {
      const size_t k = static_cast<size_t>(c);
      ASSERT_TRUE(std::isfinite(profile.wall_m[k]));
      ASSERT_GT(profile.obstacle_m[k], 0);
      ASSERT_LE(profile.obstacle_m[k], profile.wall_m[k] * 1.0001F);
      ASSERT_GE(profile.confidence[k], 0);
      ASSERT_LE(profile.confidence[k], 1.001F);
      double sum = 0;
      for (int b = 0; b < profile.wall_probability.cols(); ++b) {
        sum += profile.wall_probability(c, b);
      }
      ASSERT_NEAR(sum, 1, 1e-4);
    }
  }
}

TEST_F(AnalyzeRoom, LabelsAloneFindTheWalls) {
  StructureOptions options = Coarse();
  options.num_columns = 512;
  options.max_width = 1024;
  options.mode = StructureMode::kPaper;
  const StructureReport report = Analyze(options);
  EXPECT_GT(ColumnsWithin(report.structure, 0.1), 0.7);
  ASSERT_EQ(report.classifications.size(), scene_.views.size());
  for (const Classification& labels : report.classifications) {
    EXPECT_GT(labels.num_free_seeds, labels.num_superpixels / 5);
    EXPECT_EQ(labels.num_point_seeds, 0);
    EXPECT_LE(labels.energy, labels.seed_energy);
    EXPECT_EQ(labels.maps.final_labels.cols(), 1024);
    // As the camera saw them: its upper half has no floor, its lower half no ceiling.
    const int rows = labels.maps.final_labels.rows();
    EXPECT_EQ(labels.maps.final_labels(rows / 16, 3), static_cast<int>(SurfaceLabel::kCeiling));
    EXPECT_EQ(labels.maps.final_labels(rows - 1 - rows / 16, 3),
              static_cast<int>(SurfaceLabel::kFloor));
  }
  EXPECT_TRUE(Analyze(Coarse()).classifications.empty());
}

TEST_F(AnalyzeRoom, LabelsHelpWithEveryOtherCueSwitchedOff) {
  for (const bool use_ceiling : {true, false}) {
    for (const bool use_shared : {true, false}) {
      StructureOptions options = Coarse();
      options.mode = StructureMode::kJoint;
      options.use_ceiling = use_ceiling;
      options.use_shared = use_shared;
      options.use_frontal = use_shared;
      EXPECT_GT(ColumnsWithin(Analyze(options).structure, 0.1), 0.7) << use_ceiling << use_shared;
    }
  }
}

TEST_F(AnalyzeRoom, FindsDirectionsHeightsAndWalls) {
  scene_.camera_height_m = 1.5;
  const StructureReport report = Analyze({});
  const Structure& structure = report.structure;
  ExpectValid(structure, 3, 1024);
  EXPECT_NEAR(RadToDeg(structure.heading_rad), kHeadingDeg, 0.2);
  EXPECT_GE(ColumnsWithin(structure, 0.05), 0.85);
  ASSERT_EQ(structure.storeys.size(), 1u);
  EXPECT_NEAR(structure.storeys[0].floor_z, kFloorZ, 0.03);
  EXPECT_NEAR(structure.storeys[0].ceiling_z, kFloorZ + kHeight, 0.06);
}

TEST_F(AnalyzeRoom, EachCueCanBeSwitchedOff) {
  scene_.camera_height_m = 1.5;
  const auto share_without = [&](bool StructureOptions::*cue) {
    StructureOptions options = Coarse();
    options.*cue = false;
    const StructureReport report = Analyze(options);
    ExpectValid(report.structure, 3, 256);
    return ColumnsWithin(report.structure, 0.10);
  };
  EXPECT_GE(share_without(&StructureOptions::use_ceiling), 0.7);
  EXPECT_GE(share_without(&StructureOptions::use_correlation), 0.7);
  EXPECT_GE(share_without(&StructureOptions::use_obstacles), 0.7);
  EXPECT_GE(share_without(&StructureOptions::use_diagonals), 0.7);
  EXPECT_GE(share_without(&StructureOptions::use_frontal), 0.7);
  EXPECT_GE(share_without(&StructureOptions::use_floor), 0.0);
}

TEST_F(AnalyzeRoom, OneCueIsEnough) {
  scene_.camera_height_m = 1.5;
  for (const auto cue : {&StructureOptions::use_floor, &StructureOptions::use_ceiling,
                         &StructureOptions::use_correlation}) {
    StructureOptions options = Coarse();
    options.use_floor = options.use_ceiling = options.use_correlation = false;
    options.*cue = true;
    ExpectValid(Analyze(options).structure, 3, 256);
  }
}

TEST_F(AnalyzeRoom, NoCueIsRefused) {
  StructureOptions options = Coarse();
  options.use_floor = options.use_ceiling = options.use_correlation = false;
  EXPECT_THROW(Analyze(options), InvalidInputError);
}

TEST_F(AnalyzeRoom, SameResultForAnyNumberOfThreads) {
  scene_.camera_height_m = 1.5;
  const Structure one = Analyze(Coarse(), 1).structure, two = Analyze(Coarse(), 2).structure;
  EXPECT_EQ(one.heading_rad, two.heading_rad);
  EXPECT_EQ(one.storeys[0].floor_z, two.storeys[0].floor_z);
  EXPECT_EQ(one.storeys[0].ceiling_z, two.storeys[0].ceiling_z);
  for (size_t i = 0; i < one.profiles.size(); ++i) {
    EXPECT_EQ(one.profiles[i].wall_m, two.profiles[i].wall_m);
    EXPECT_EQ(one.profiles[i].obstacle_m, two.profiles[i].obstacle_m);
    EXPECT_EQ(one.profiles[i].confidence, two.profiles[i].confidence);
    EXPECT_EQ(one.profiles[i].wall_probability.data(), two.profiles[i].wall_probability.data());
  }
}

}  // namespace
}  // namespace enfilade
