// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/synthetic/render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "enfilade/base/errors.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/scene/camera.h"
#include "enfilade/scene/virtual_view.h"
#include "enfilade/synthetic/text_home.h"
#include "enfilade/synthetic/truth.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr ImageSize kSize{256, 128};

RenderOptions Quick() {
  RenderOptions options;
  options.samples_per_pixel = 1;
  options.gather_rays = 16;
  options.bounces = 1;
  options.light_cell_m = 0.15;
  return options;
}

RenderedPanorama RenderFirst(const Home& home, const RenderOptions& options) {
  RunContext context;
  return HomeRenderer(home, options, context).Render(0, kSize, context);
}

Vector3d RayInHome(const Home& home, int row, int col) {
  const Camera camera = EquirectangularCamera(kSize.width, kSize.height);
  return home.cameras[0].home_from_cam.rotation * camera.RayFromPixel({col + 0.5, row + 0.5});
}

TEST(Render, TruthOfAnEmptyRoomIsThatOfABox) {
  TextHomeOptions options;
  options.baseboard_m = 0;
  options.heading_rad = 0.5;
  options.floor_z = -0.2;
  const Home home = TextHome("room 0,0 4,0 4,3 0,3 | camera 1,1.2", options);
  const RenderedPanorama out = RenderFirst(home, Quick());
  const Vector3d low(0, 0, -0.2), high(4, 3, 2.3), eye(1, 1.2, 1.3);
  const Eigen::Matrix3d world_from_home = home.home_from_world.rotation.transpose();
  int num_lamp = 0;
  for (int row = 0; row < 110; ++row) {
    for (int col = 0; col < kSize.width; ++col) {
      if (out.label(row, col) == static_cast<uint8_t>(SurfaceLabel::kOther)) {
        ++num_lamp;
        continue;
      }
      const Vector3d ray = RayInHome(home, row, col);
      double exit_m = 1e9;
      int axis = 0;
      for (int k = 0; k < 3; ++k) {
        const double t = ((ray[k] > 0 ? high[k] : low[k]) - eye[k]) / ray[k];
        if (t < exit_m) {
          exit_m = t;
          axis = k;
        }
      }
      ASSERT_NEAR(out.range_m(row, col), exit_m, 1e-4) << row << ' ' << col;
      const SurfaceLabel expected = axis < 2      ? SurfaceLabel::kWall
                                    : ray.z() > 0 ? SurfaceLabel::kCeiling
                                                  : SurfaceLabel::kFloor;
      ASSERT_EQ(out.label(row, col), static_cast<uint8_t>(expected));
      ASSERT_EQ(out.room_id(row, col), 0);
      ASSERT_EQ(out.wall_id(row, col) >= 0, axis < 2);
      Vector3d normal = Vector3d::Zero();
      normal[axis] = ray[axis] > 0 ? -1 : 1;
      normal = world_from_home * normal;
      for (int k = 0; k < 3; ++k) ASSERT_NEAR(out.normal(row, col, k), normal[k], 1e-6);
    }
  }
  EXPECT_GT(num_lamp, 10);
  EXPECT_LT(num_lamp, 800);
}

// Near an opening frames stand proud of the wall and leaves lie behind it.
bool IsNearOpening(const Home& home, const Vector2d& p) {
  return std::any_of(home.openings.begin(), home.openings.end(), [&](const HomeOpening& opening) {
    const Vector2d through = opening.thickness_m * opening.IntoWall();
    return std::min(DistanceToSegment(p, opening.a, opening.b),
                    DistanceToSegment(p, opening.a + through, opening.b + through)) < 0.08;
  });
}

TEST(Render, HorizonAgreesWithRaysInThePlan) {
  for (const int seed : {3, 8}) {
    HomeOptions options;
    options.seed = seed;
    options.furniture = 0;
    const Home home = MakeHome(options);
    const RenderedPanorama out = RenderFirst(home, Quick());
    const PlanSegments segments = MakePlanSegments(home);
    const Vector2d eye = home.cameras[0].home_from_cam.translation.head<2>();
    const int row = kSize.height / 2;
    int num_compared = 0;
    for (int col = 0; col < kSize.width; ++col) {
      const Vector3d ray = RayInHome(home, row, col);
      const double level = ray.head<2>().norm();
      const Vector2d direction = ray.head<2>() / level;
      const auto wall = CastPlanRay(segments.walls, eye, direction);
      const auto obstacle = CastPlanRay(segments.obstacles, eye, direction);
      ASSERT_TRUE(wall.has_value());
      double expected_m = wall->distance_m;
      if (obstacle) expected_m = std::min(expected_m, obstacle->distance_m);
      if (IsNearOpening(home, eye + expected_m * direction)) continue;
      const bool is_leaf = expected_m < wall->distance_m;
      EXPECT_NEAR(out.range_m(row, col) * level, expected_m, is_leaf ? 0.03 : 1e-3);
      if (!is_leaf) {
        EXPECT_EQ(out.wall_id(row, col),
                  segments.walls[static_cast<size_t>(wall->segment_idx)].wall_id);
      }
      ++num_compared;
    }
    EXPECT_GT(num_compared, kSize.width / 2);
  }
}

TEST(Render, SameBytesForOneAndTwoThreads) {
  const Home home = TextHome(
      "room 0,0 3,0 3,2.5 0,2.5 | room 3.1,0 5,0 5,2.5 3.1,2.5 | door 3,1 3,1.8 | window 1,0 2,0 | "
      "box 0.1,1.8 0.8,2.4 | camera 1.6,1.4");
  RunContext one(1), two(2);
  const RenderedPanorama a = HomeRenderer(home, Quick(), one).Render(0, kSize, one);
  const RenderedPanorama b = HomeRenderer(home, Quick(), two).Render(0, kSize, two);
  EXPECT_EQ(a.rgb.data(), b.rgb.data());
  EXPECT_EQ(a.range_m.data(), b.range_m.data());
  EXPECT_EQ(a.label.data(), b.label.data());
}

TEST(Render, HomesOfFiveSeedsHaveTheSameBytesForOneThreadAndTwo) {
  RenderOptions options = Quick();
  options.gather_rays = 16;
  options.light_cell_m = 0.3;
  constexpr ImageSize kSmall{128, 64};
  for (const int seed : {1, 2, 3, 4, 5}) {
    HomeOptions home_options;
    home_options.seed = seed;
    home_options.preset = seed < 4 ? HomePreset::kTour : HomePreset::kFlat;
    const Home home = MakeHome(home_options);
    RunContext one(1), two(2);
    const HomeRenderer alone(home, options, one), shared(home, options, two);
    for (int i = 0; i < static_cast<int>(home.cameras.size()); ++i) {
      const RenderedPanorama a = alone.Render(i, kSmall, one), b = shared.Render(i, kSmall, two);
      ASSERT_EQ(a.rgb.data(), b.rgb.data()) << "seed " << seed << ", camera " << i;
      ASSERT_EQ(a.range_m.data(), b.range_m.data());
      ASSERT_EQ(a.normal.data(), b.normal.data());
      ASSERT_EQ(a.label.data(), b.label.data());
      ASSERT_EQ(a.room_id.data(), b.room_id.data());
      ASSERT_EQ(a.wall_id.data(), b.wall_id.data());
    }
  }
}

TEST(Render, WhiteWallsLookWhite) {
  for (const int seed : {1, 2}) {
    HomeOptions options;
    options.seed = seed;
    const Home home = MakeHome(options);
    const RenderedPanorama out = RenderFirst(home, Quick());
    double sum = 0, colour = 0, count = 0;
    for (int row = 0; row < kSize.height; ++row) {
      for (int col = 0; col < kSize.width; ++col) {
        if (out.label(row, col) != static_cast<uint8_t>(SurfaceLabel::kWall)) continue;
        const uint8_t* p = &out.rgb(row, col);
        sum += (p[0] + p[1] + p[2]) / 3.0;
        colour += std::max({p[0], p[1], p[2]}) - std::min({p[0], p[1], p[2]});
        ++count;
      }
    }
    EXPECT_GT(count, 0.2 * kSize.width * kSize.height);
    EXPECT_GT(sum / count, 165);
    EXPECT_LT(sum / count, 235);
    EXPECT_LT(colour / count, 30);
  }
}

TEST(Render, ReflectedLightReachesWhatNoLampSees) {
  // The ceiling of the far corner sees the lamp's rim only; without bounces it is almost black.
  const Home home = TextHome("room 0,0 5,0 5,4 0,4 | camera 1,1");
  RenderOptions dark = Quick();
  dark.bounces = 0;
  dark.noise = 0;
  RenderOptions lit = dark;
  lit.bounces = 3;
  const RenderedPanorama a = RenderFirst(home, dark), b = RenderFirst(home, lit);
  const auto ceiling_to_floor = [](const RenderedPanorama& out) {
    double sums[2] = {0, 0}, counts[2] = {1e-9, 1e-9};
    for (int row = 0; row < kSize.height; ++row) {
      for (int col = 0; col < kSize.width; ++col) {
        const int label = out.label(row, col);
        const int k = label == static_cast<int>(SurfaceLabel::kCeiling) ? 0 : 1;
        if (k == 1 && label != static_cast<int>(SurfaceLabel::kFloor)) continue;
        sums[k] += out.rgb(row, col, 1);
        counts[k] += 1;
      }
    }
    return (sums[0] / counts[0]) / (sums[1] / counts[1]);
  };
  EXPECT_LT(ceiling_to_floor(a), 0.6);
  EXPECT_GT(ceiling_to_floor(b), 0.8);
}

TEST(Render, NoLightLeaksThroughTheShell) {
  Home home = TextHome(
      "room 0,0 4,0 4,3 0,3 | room 4.1,0 8,0 8,3 4.1,3 | door 4,1 4,1.8 | closed 1,0 1.9,0");
  home.lamps.clear();
  RenderOptions options = Quick();
  options.noise = 0;
  const RenderedPanorama out = RenderFirst(home, options);
  for (int row = 0; row < 110; ++row) {
    for (int col = 0; col < kSize.width; ++col)
      ASSERT_EQ(out.rgb(row, col, 1), 0) << row << ' ' << col;
  }
}

// A dark sheet of glass on the wall before the camera: without its mirror image it would be black.
TEST(Render, AMirrorShowsTheRoom) {
  Home home = TextHome("room 0,0 4,0 4,3 0,3 | box 3.9,0.5 3.95,2.5 height 2.2 | camera 1,1.5");
  home.boxes[0].rgb = {0.03f, 0.03f, 0.03f};
  const auto brightness = [&](Finish finish) {
    home.boxes[0].finish = finish;
    const RenderedPanorama out = RenderFirst(home, Quick());
    double sum = 0;
    int count = 0;
    for (int row = 58; row < 68; ++row) {
      for (int col = 0; col < kSize.width; ++col) {
        const Vector3d ray = RayInHome(home, row, col);
        if (ray.x() < 0.98) continue;
        EXPECT_EQ(out.label(row, col), static_cast<uint8_t>(SurfaceLabel::kOther));
        sum += out.rgb(row, col, 1);
        ++count;
      }
    }
    return sum / count;
  };
  EXPECT_LT(brightness(Finish::kPlain), 80);
  EXPECT_GT(brightness(Finish::kMirror), 140);
}

TEST(Render, ASlopedCeilingIsAPlane) {
  Home home = TextHome("room 0,0 4,0 4,3 0,3 | camera 2,1.2");
  home.rooms[0].ceiling_slope = {0.3, -0.1};
  const Vector3d eye(2, 1.2, 1.5), up = Vector3d(-0.3, 0.1, 1).normalized();
  const Vector3d lowest(0, 3, 2.5);
  const RenderedPanorama out = RenderFirst(home, Quick());
  int num_ceiling = 0;
  for (int row = 0; row < kSize.height / 2; ++row) {
    for (int col = 0; col < kSize.width; ++col) {
      if (out.label(row, col) != static_cast<uint8_t>(SurfaceLabel::kCeiling)) continue;
      ++num_ceiling;
      const Vector3d ray = RayInHome(home, row, col);
      ASSERT_NEAR(out.range_m(row, col), up.dot(lowest - eye) / up.dot(ray), 1e-4);
      for (int k = 0; k < 3; ++k) ASSERT_NEAR(out.normal(row, col, k), -up[k], 1e-5);
    }
  }
  EXPECT_GT(num_ceiling, 4000);
  EXPECT_NEAR(TruthFloorplan(home).storeys[0].rooms[0].ceiling_z, 2.5 + 0.3 * 2 + 0.1 * 1.5, 1e-9);
  EXPECT_FALSE(TruthFloorplan(home).storeys[0].rooms[0].has_level_ceiling);
}

TEST(Render, ExposureBrightensThePicture) {
  Home home = TextHome("room 0,0 4,0 4,3 0,3 | camera 2,1.2");
  const RenderedPanorama usual = RenderFirst(home, Quick());
  home.cameras[0].exposure = 1.5;
  const RenderedPanorama bright = RenderFirst(home, Quick());
  EXPECT_GT(bright.rgb(64, 10, 1), usual.rgb(64, 10, 1) + 10);
}

TEST(Render, GlassShowsTheNextRoomAndFaintlyOnesOwn) {
  Home home = TextHome(
      "room 0,0 4,0 4,3 0,3 | room 4.1,0 8,0 8,3 4.1,3 | camera 3.6,0.4 | opening 4,0.5 4,2.5");
  home.lamps.pop_back();  // the next room is dark
  home.openings[0].head_z = 2.2;
  const Camera camera = EquirectangularCamera(kSize.width, kSize.height);
  const Vector3d look = home.cameras[0].home_from_cam.rotation.transpose() * Vector3d(0.4, 1.2, 0);
  const Vector2d pixel = camera.PixelFromRay(look).value();
  const int row = static_cast<int>(pixel.y()), col = static_cast<int>(pixel.x());
  const RenderedPanorama open = RenderFirst(home, Quick());
  home.openings[0].kind = OpeningKind::kWindow;
  ASSERT_TRUE(HomeProblems(home).empty());
  const RenderedPanorama glazed = RenderFirst(home, Quick());
  EXPECT_EQ(open.room_id(row, col), 1);
  EXPECT_EQ(glazed.room_id(row, col), 1);
  EXPECT_EQ(glazed.range_m(row, col), open.range_m(row, col));
  EXPECT_GT(glazed.rgb(row, col, 1), open.rgb(row, col, 1) + 10);
}

TEST(Render, TheSunDrawsItsPatchWhereTheWindowLetsItIn) {
  Home home =
      TextHome("room 0,0 4,0 4,3 0,3 | window 1.4,0 2.6,0 | camera 0.9,2.2", {.baseboard_m = 0});
  const auto brightness_at = [&](const Vector3d& p) {
    RunContext context;
    const RenderedPanorama out = HomeRenderer(home, Quick(), context).Render(0, kSize, context);
    const Rigid3& home_from_cam = home.cameras[0].home_from_cam;
    const Vector3d ray = home_from_cam.rotation.transpose() * (p - home_from_cam.translation);
    const auto pixel = EquirectangularCamera(kSize.width, kSize.height).PixelFromRay(ray).value();
    return static_cast<int>(out.rgb(static_cast<int>(pixel.y()), static_cast<int>(pixel.x()), 1));
  };
  const HomeOpening& window = home.openings.at(0);
  const Vector3d pane(1.7, -0.5 * window.thickness_m, 0.5 * (window.sill_z + window.head_z));
  const Vector3d sun = Vector3d(0.1, -1, 1).normalized();
  const Vector3d lit = pane - sun * (pane.z() / sun.z());
  const Vector3d shaded(3.5, lit.y(), 0);
  const int lit_before = brightness_at(lit), shaded_before = brightness_at(shaded);
  home.sun = HomeSun{sun};
  EXPECT_GT(brightness_at(lit), lit_before + 25);
  EXPECT_LT(std::abs(brightness_at(shaded) - shaded_before), 25);
}

TEST(Render, StandCoversTheBottomAndHasNoTruth) {
  const Home home = TextHome("room 0,0 4,0 4,3 0,3");
  RenderOptions options = Quick();
  options.stand_share = 0.08;
  const RenderedPanorama out = RenderFirst(home, options);
  for (int col = 0; col < kSize.width; ++col) {
    for (const int row : {120, 127}) {
      EXPECT_LT(out.rgb(row, col, 0), 60);
      EXPECT_EQ(out.range_m(row, col), 0);
      EXPECT_EQ(out.label(row, col), static_cast<uint8_t>(SurfaceLabel::kOther));
      EXPECT_EQ(out.room_id(row, col), -1);
    }
    EXPECT_GT(out.range_m(112, col), 0);
  }
}

// Pinhole views show what a virtual view of the panorama shows.
TEST(Render, ViewsAgreeWithThePanorama) {
  const Home home = TextHome(
      "room 0,0 4,0 4,3 0,3 | room 4.1,0 8,0 8,3 4.1,3 | door 4,1 4,1.8 | window 1,0 2,0 | "
      "box 2.5,2 3.5,2.8 height 0.8 | camera 1,1.4");
  RenderOptions options = Quick();
  options.samples_per_pixel = 4;
  options.noise = options.blur_px = options.stand_share = 0;
  RunContext context;
  const HomeRenderer renderer(home, options, context);
  constexpr ImageSize kLarge{1024, 512};
  const RenderedPanorama panorama = renderer.Render(0, kLarge, context);
  const Camera pano_camera = EquirectangularCamera(kLarge.width, kLarge.height);
  const Camera camera = PinholeCamera(120, 80, 100, 100, 55, 42);
  for (const double yaw : {0.3, 2.5}) {
    const Eigen::Matrix3d pano_from_view =
        (Eigen::AngleAxisd(yaw, Vector3d::UnitY()) * Eigen::AngleAxisd(0.2, Vector3d::UnitX()))
            .toRotationMatrix();
    const RenderedPanorama view = renderer.RenderView(0, camera, pano_from_view, context);
    ASSERT_EQ(view.rgb.rows(), 80);
    ASSERT_EQ(view.label.cols(), 120);
    const ImageU8 expected = RenderVirtualView(panorama.rgb, pano_camera, camera, pano_from_view);
    double difference = 0;
    for (size_t i = 0; i < expected.data().size(); ++i)
      difference += std::abs(expected.data()[i] - view.rgb.data()[i]);
    EXPECT_LT(difference / static_cast<double>(expected.data().size()), 3);
    int num_different = 0;
    for (int row = 0; row < 80; ++row) {
      for (int col = 0; col < 120; ++col) {
        const Vector3d ray = pano_from_view * camera.RayFromPixel({col + 0.5, row + 0.5});
        const Vector2d pixel = pano_camera.PixelFromRay(ray).value();
        const int r = static_cast<int>(pixel.y()), c = static_cast<int>(pixel.x());
        num_different += panorama.label(r, c) != view.label(row, col) ||
                                 std::abs(panorama.range_m(r, c) - view.range_m(row, col)) > 0.1
                             ? 1
                             : 0;
      }
    }
    EXPECT_LT(num_different, 0.03 * 80 * 120);  // at edges
  }
}

TEST(Render, RefusesOptionsOutOfRange) {
  RunContext context;
  RenderOptions options;
  options.samples_per_pixel = 0;
  EXPECT_THROW(HomeRenderer(TextHome("room 0,0 4,0 4,3 0,3"), options, context), InvalidInputError);
}

// Also out of the windows, where the other storey would stand in the view.
TEST(Render, CamerasSeeTheirOwnStoreyOnly) {
  constexpr ImageSize kSmall{128, 64};
  const Home home = MakeHome({.seed = 2, .storeys = 2});
  RunContext context(2);
  RenderOptions options = Quick();
  options.light_cell_m = 0.3;
  const HomeRenderer renderer(home, options, context);
  for (int i = 0; i < static_cast<int>(home.cameras.size()); ++i) {
    const RenderedPanorama out = renderer.Render(i, kSmall, context);
    int64_t num_rooms_seen = 0, grey = 0;
    for (const int16_t room_id : out.room_id.data()) {
      if (room_id < 0) continue;
      ++num_rooms_seen;
      ASSERT_TRUE(home.IsOnStorey(room_id, home.StoreyOfCamera(i)));
    }
    for (const uint8_t value : out.rgb.data()) grey += value;
    EXPECT_GT(num_rooms_seen, 0.8 * kSmall.width * kSmall.height);
    EXPECT_GT(static_cast<double>(grey) / static_cast<double>(out.rgb.data().size()), 90);
  }
}

}  // namespace
}  // namespace enfilade
