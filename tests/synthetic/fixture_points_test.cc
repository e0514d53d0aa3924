// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/synthetic/fixture_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "enfilade/geometry/angles.h"
#include "enfilade/synthetic/text_home.h"
#include "enfilade/synthetic/truth.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Every place is found wherever it is seen.
PointNoise Perfect() {
  PointNoise noise;
  noise.spacing_m = 0.1;
  noise.half_contrast = 0;
  noise.match_probability = 1;
  noise.match_sigma_deg = noise.ray_sigma_deg = noise.normal_sigma_deg = 0;
  noise.outlier_share = noise.clump_share = noise.hole_share = 0;
  return noise;
}

Home TwoRooms() {
  TextHomeOptions options;
  options.baseboard_m = 0;
  return TextHome(
      "room 0,0 4,0 4,3 0,3 | room 4.12,0 8,0 8,3 4.12,3 | door 4,1 4,1.8 | camera 1,1.5 | camera "
      "2.5,1 | camera 6,1.4",
      options);
}

// Distance of a point in the home frame to the nearest wall, floor or ceiling.
double ToShell(const Home& home, const Vector3d& p) {
  double nearest_m = 1e9;
  for (const HomeRoom& room : home.rooms) {
    if (!Contains(room.polygon, p.head<2>())) continue;
    nearest_m = std::min(std::abs(p.z() - room.floor_z), std::abs(p.z() - room.ceiling_z));
  }
  for (const HomeWall& wall : HomeWalls(home)) {
    const HomeRoom& room = home.RoomById(wall.room_id);
    if (p.z() < room.floor_z || p.z() > room.ceiling_z) continue;
    nearest_m = std::min(nearest_m, DistanceToSegment(p.head<2>(), wall.a, wall.b));
  }
  return nearest_m;
}

TEST(FixturePoints, PerfectOnesLieWhereTwoCamerasLook) {
  const Home home = TwoRooms();
  const PlanSegments segments = MakePlanSegments(home);
  const std::vector<ScenePoint> points = FixturePoints(home, Perfect());
  ASSERT_GT(points.size(), 4000u);
  int num_at_reveals = 0;
  for (const ScenePoint& point : points) {
    const Vector3d p = home.home_from_world * point.position;
    num_at_reveals += ToShell(home, p) > 1e-4 ? 1 : 0;
    ASSERT_GE(point.view_idx.size(), 2u);
    ASSERT_TRUE(std::is_sorted(point.view_idx.begin(), point.view_idx.end()));
    double widest_rad = 0;
    for (const int i : point.view_idx) {
      const Vector3d camera = home.cameras[static_cast<size_t>(i)].home_from_cam.translation;
      const Vector2d offset = (p - camera).head<2>();
      EXPECT_GT(point.normal.dot(home.home_from_world.rotation.transpose() * (camera - p)), 0);
      // No wall stands between them in the plan.
      const auto wall =
          CastPlanRay(segments.walls, camera.head<2>(), Vector2d(offset.normalized()));
      EXPECT_TRUE(!wall || wall->distance_m > offset.norm() - 0.01);
      for (const int j : point.view_idx) {
        const Vector3d other = home.cameras[static_cast<size_t>(j)].home_from_cam.translation;
        widest_rad = std::max(widest_rad,
                              std::acos((camera - p).normalized().dot((other - p).normalized())));
      }
    }
    EXPECT_GT(widest_rad, DegToRad(9.99));
  }
  EXPECT_LT(num_at_reveals, 0.02 * static_cast<double>(points.size()));  // door frame and jambs
}

TEST(FixturePoints, DepthNoiseGrowsWithTheSquareOfTheDistanceOverTheBaseline) {
  const Home home = TextHome("room 0,0 6,0 6,4 0,4 | camera 1,2 | camera 2.2,1.5");
  PointNoise noise = Perfect();
  const std::vector<ScenePoint> truth = FixturePoints(home, noise);
  noise.match_sigma_deg = 0.1;
  noise.ray_sigma_deg = 0.05;
  const std::vector<ScenePoint> noisy = FixturePoints(home, noise);
  ASSERT_EQ(noisy.size(), truth.size());
  double along_squares[2] = {0, 0}, across_squares = 0, count[2] = {0, 0};
  for (size_t i = 0; i < truth.size(); ++i) {
    const Vector3d& p = truth[i].position;
    Vector3d near = home.WorldFromCamera(0).translation, far = home.WorldFromCamera(1).translation;
    if ((far - p).norm() < (near - p).norm()) std::swap(near, far);
    const Vector3d ray = (p - near).normalized(), error = noisy[i].position - p;
    const double d = (p - near).norm(), b = (far - near).cross(ray).norm();
    const int is_far = d > 2.5 ? 1 : 0;
    along_squares[is_far] += std::pow(error.dot(ray) / (DegToRad(0.1) * d * d / b), 2);
    across_squares += error.cross(ray).squaredNorm() / std::pow(DegToRad(0.05) * d, 2);
    ++count[is_far];
  }
  EXPECT_NEAR(std::sqrt(along_squares[0] / count[0]), 1, 0.03);
  EXPECT_NEAR(std::sqrt(along_squares[1] / count[1]), 1, 0.03);
  EXPECT_NEAR(across_squares / (count[0] + count[1]), 2, 0.06);
}

TEST(FixturePoints, SharesAreAsAsked) {
  const Home home = TextHome("room 0,0 6,0 6,4 0,4 | camera 1,2 | camera 2.2,1.5");
  const std::vector<ScenePoint> truth = FixturePoints(home, Perfect());
  const auto n = static_cast<double>(truth.size());
  const auto share_moved = [&](const PointNoise& noise) {
    const std::vector<ScenePoint> points = FixturePoints(home, noise);
    EXPECT_EQ(points.size(), truth.size());
    double num_moved = 0;
    for (size_t i = 0; i < points.size(); ++i)
      num_moved += (points[i].position - truth[i].position).norm() > 1e-6 ? 1 : 0;
    return num_moved / n;
  };
  PointNoise outliers = Perfect(), clumps = Perfect(), holes = Perfect(), matches = Perfect();
  outliers.outlier_share = 0.2;
  EXPECT_NEAR(share_moved(outliers), 0.2, 0.02);
  clumps.clump_share = 0.1;
  EXPECT_NEAR(share_moved(clumps), 0.1, 0.02);
  holes.hole_share = 0.3;
  holes.hole_radius_m = 0.1;
  EXPECT_NEAR(static_cast<double>(FixturePoints(home, holes).size()) / n, 0.7, 0.03);
  // Both cameras have to recognise a place.
  matches.match_probability = 0.7;
  EXPECT_NEAR(static_cast<double>(FixturePoints(home, matches).size()) / n, 0.49, 0.02);
}

TEST(FixturePoints, WhiteWallsHaveFewAndCarpetsMany) {
  const Home home = TextHome("room 0,0 5,0 5,4 0,4 | camera 1,2 | camera 3,1.5");
  PointNoise noise = Perfect();
  const auto count = [&](const PointNoise& asked, bool is_floor) {
    double sum = 0;
    for (const ScenePoint& point : FixturePoints(home, asked)) {
      const double z = point.position.z();
      sum += is_floor ? std::abs(z) < 1e-4 : z > 0.3 && z < 2.2;  // clear of edges and baseboards
    }
    return sum;
  };
  const double floor = count(noise, true), walls = count(noise, false);
  noise.half_contrast = PointNoise().half_contrast;
  EXPECT_GT(count(noise, true), 0.6 * floor);
  EXPECT_LT(count(noise, false), 0.2 * walls);
}

TEST(FixturePoints, AMirrorShowsPointsBehindIt) {
  Home home = TextHome(
      "room 0,0 4,0 4,3 0,3 | box 3.9,0.2 3.95,2.8 height 2.2 | camera 1,1.2 | camera 2,2");
  const auto num_behind = [&] {
    int count = 0;
    for (const ScenePoint& point : FixturePoints(home, Perfect())) {
      const Vector3d p = home.home_from_world * point.position;
      if (p.x() < 4.01) continue;
      ++count;
      // Its image lies on the shell of the room, or on the box.
      const Vector3d image(2 * 3.9 - p.x(), p.y(), p.z());
      EXPECT_LT(std::min(ToShell(home, image), std::abs(image.x() - 3.9)), 0.08);  // or baseboard
    }
    return count;
  };
  EXPECT_EQ(num_behind(), 0);
  home.boxes[0].finish = Finish::kMirror;
  EXPECT_GT(num_behind(), 200);
}

// PMVS2 on a real unfurnished home: 41 % of the points within 5 cm of a true plane, 58 % within
// 10 cm.
TEST(FixturePoints, DefaultsAreAsAccurateAsPatchesOfARealHome) {
  const Home home = TextHome(
      "room 0,0 5,0 5,4 0,4 | room 5.12,0 9,0 9,4 5.12,4 | room 0,4.12 9,4.12 9,5.4 0,5.4 | "
      "room 0,5.52 4,5.52 4,9 0,9 | room 4.12,5.52 9,5.52 9,9 4.12,9 | door 2,4 3,4 | door 6,4 7,4 "
      "| "
      "door 2,5.4 3,5.4 | door 6,5.4 7,5.4 | window 1,0 2.5,0 | window 5,9 7,9 | camera 1.5,1.5 | "
      "camera 3.5,2.6 | camera 6.2,1.4 | camera 8,2.8 | camera 1.5,4.8 | camera 6.8,4.7 | "
      "camera 1.2,7 | camera 3,8 | camera 5.3,7 | camera 7.7,7.8");
  double within_5cm = 0, within_10cm = 0, count = 0;
  for (const uint64_t seed : {1, 2, 3}) {
    PointNoise noise;
    noise.spacing_m = 0.1;
    noise.seed = seed;
    for (const ScenePoint& point : FixturePoints(home, noise)) {
      const double distance_m = ToShell(home, point.position);
      within_5cm += distance_m < 0.05 ? 1 : 0;
      within_10cm += distance_m < 0.1 ? 1 : 0;
      ++count;
    }
  }
  EXPECT_GT(count, 3000);
  EXPECT_NEAR(within_5cm / count, 0.41, 0.03);
  EXPECT_NEAR(within_10cm / count, 0.58, 0.03);
}

}  // namespace
}  // namespace enfilade
