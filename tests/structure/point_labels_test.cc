// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/point_labels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace enfilade {
namespace {

TEST(LabelPoints, ByTheStoreyOfWhoSeesThem) {
  Scene scene;
  scene.views.resize(2);
  scene.views[1].storey_idx = 1;
  Structure structure;
  structure.home_from_world.rotation = RotationZ(0.3);
  structure.storeys = {{0, 2.5, 0}, {2.8, 5.2, 0}};
  const auto add = [&](double z, const Eigen::Vector3d& normal, std::vector<int> views) {
    scene.points.push_back({{1, 2, z}, normal, {0, 0, 0}, std::move(views), {}});
  };
  const Eigen::Vector3d up(0, 0, 1), side(0.6, 0.8, 0);
  add(2.75, up, {1});    // floor above, seen from above
  add(2.75, up, {0});    // from below it would be a shelf
  add(2.45, -up, {0});   // ceiling below
  add(2.65, side, {1});  // below the upper floor
  add(1, side, {0, 1});
  add(1, side, {});
  EXPECT_THAT(
      LabelPoints(scene, structure),
      testing::ElementsAre(SurfaceLabel::kFloor, SurfaceLabel::kOther, SurfaceLabel::kCeiling,
                           SurfaceLabel::kOther, SurfaceLabel::kWall, SurfaceLabel::kOther));
}

}  // namespace
}  // namespace enfilade
