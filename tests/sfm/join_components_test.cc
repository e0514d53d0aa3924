// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/join_components.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "enfilade/geometry/angles.h"
#include "tests/sfm/box_outline.h"
#include "tests/sfm/registration_scene.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kHalfThickness = 0.03;  // of the made scene's partitions

// Rooms in a row, a component each, turned by quarters and moved out of their places.
struct Apart {
  RegistrationScene scene;
  std::vector<Rigid3> component_from_world, world_from_cam;
  std::vector<int> component_idx;
  std::vector<RoomOutline> outlines;

  explicit Apart(const MadeSceneOptions& options) {
    std::vector<MadeCamera> cameras;
    for (size_t room = 0; room + 1 < options.wall_x.size(); ++room) {
      const double x0 = options.wall_x[room], x1 = options.wall_x[room + 1];
      const double middle = (x0 + x1) / 2;
      cameras.push_back({{middle - 0.7, 0.45 * options.depth}, 0.3});
      cameras.push_back({{middle + 0.6, 0.6 * options.depth}, 2.0});
      component_idx.insert(component_idx.end(), 2, static_cast<int>(room));
      const double quarters = static_cast<double>(room) * kPi / 2;
      component_from_world.push_back({RotationZ(quarters), Vector3d(5.0 * quarters, -1, 0)});
    }
    scene = MakeRegistrationScene(options, cameras);
    for (size_t i = 0; i < cameras.size(); ++i) {
      const size_t room = i / 2;
      const Rigid3& place = component_from_world[room];
      world_from_cam.push_back(place * scene.world_from_cam[i]);
      RoomOutline outline = BoxOutline({options.wall_x[room] + kHalfThickness, 0},
                                       {options.wall_x[room + 1] - kHalfThickness, options.depth},
                                       cameras[i].at, options.ceiling);
      outline.first_azimuth_rad += static_cast<double>(room) * kPi / 2;
      outlines.push_back(outline);
    }
  }

  [[nodiscard]] std::vector<ComponentJoin> Join(int num_threads = 2) const {
    RunContext context(num_threads);
    return JoinComponents({world_from_cam, component_idx, scene.features, scene.gravity, outlines},
                          {}, context);
  }

  [[nodiscard]] Rigid3 TrueJoin(const ComponentJoin& join) const {
    return component_from_world[static_cast<size_t>(join.a)] *
           component_from_world[static_cast<size_t>(join.b)].Inverse();
  }
};

MadeSceneOptions TwoRooms() {
  MadeSceneOptions options;
  options.wall_x = {0, 3.2, 6.0};
  options.is_door_open = {true};
  options.noise_rad = DegToRad(0.1);
  options.seen_share = 0.5;
  options.false_share = 0.2;
  options.lone_share = 1;
  return options;
}

void ExpectTrue(const Apart& apart, const ComponentJoin& join) {
  const Rigid3 error = join.a_from_b.Inverse() * apart.TrueJoin(join);
  EXPECT_LT(error.translation.norm(), 0.06) << join.a << "–" << join.b;
  EXPECT_LT(std::abs(std::atan2(error.rotation(1, 0), error.rotation(0, 0))), DegToRad(0.5));
}

TEST(JoinComponents, FindsTheDoorBetweenTwoRooms) {
  const Apart apart(TwoRooms());
  const std::vector<ComponentJoin> joins = apart.Join();
  ASSERT_EQ(joins.size(), 1U);
  ExpectTrue(apart, joins[0]);
  size_t num_true = 0, num_all = 0;
  for (const DoorPair& pair : joins[0].pairs) {
    EXPECT_LT(pair.a_idx, pair.b_idx);
    for (const FeatureMatch& match : pair.inliers) {
      const auto point = [&](int view, int feature) {
        return apart.scene
            .point_of_feature[static_cast<size_t>(view)][static_cast<size_t>(feature)];
      };
      num_true += point(pair.a_idx, match.a_idx) >= 0 &&
                  point(pair.a_idx, match.a_idx) == point(pair.b_idx, match.b_idx);
      ++num_all;
    }
  }
  EXPECT_GT(10 * num_true, 9 * num_all);
}

TEST(JoinComponents, JoinsThreeRoomsInARow) {
  MadeSceneOptions options = TwoRooms();
  options.wall_x = {0, 3.2, 6.0, 9.4};
  options.is_door_open = {true, true};
  const Apart apart(options);
  const std::vector<ComponentJoin> joins = apart.Join();
  ASSERT_EQ(joins.size(), 2U);
  for (const ComponentJoin& join : joins) {
    EXPECT_EQ(join.b, join.a + 1);
    ExpectTrue(apart, join);
  }
  EXPECT_GE(joins[0].log_odds, joins[1].log_odds);
}

TEST(JoinComponents, LeavesRoomsApartThatNoDoorTies) {
  MadeSceneOptions options = TwoRooms();
  options.is_door_open = {false};
  for (uint32_t seed = 1; seed <= 5; ++seed) {
    options.seed = seed;
    EXPECT_TRUE(Apart(options).Join().empty()) << "seed " << seed;
  }
}

TEST(JoinComponents, SaysTheSameForAnyNumberOfThreads) {
  const Apart apart(TwoRooms());
  const std::vector<ComponentJoin> one = apart.Join(1), three = apart.Join(3);
  ASSERT_EQ(one.size(), three.size());
  for (size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].a_from_b.translation, three[i].a_from_b.translation);
    EXPECT_EQ(one[i].log_odds, three[i].log_odds);
  }
}

TEST(JoinComponents, HasNothingToDoForOneComponentOrNone) {
  Apart apart(TwoRooms());
  apart.component_idx.assign(apart.component_idx.size(), 0);
  EXPECT_TRUE(apart.Join().empty());
  RunContext context(1);
  EXPECT_TRUE(JoinComponents({}, {}, context).empty());
}

}  // namespace
}  // namespace enfilade
