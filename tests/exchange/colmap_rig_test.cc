// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/colmap_rig.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>

#include "enfilade/base/json.h"
#include "tests/exchange/box_scene.h"
#include "tests/exchange/rig_axis.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Every direction lies in the picture of the view that it goes to, up to rounding at corners.
TEST(ColmapRig, ViewsLeaveNoDirectionOut) {
  const ColmapRig rig = RigFor(MakeBoxScene());
  constexpr int kSteps = 400;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double z = -1 + 2 * (i + 0.5) / kSteps, angle = 2 * M_PI * j / kSteps;
      const double r = std::sqrt(1 - z * z);
      const Vector3d ray(r * std::sin(angle), z, r * std::cos(angle));
      const size_t slot = rig.SlotOf(ray);
      for (int k = 0; k < 10; ++k) {
        ASSERT_GE(RigAxis(static_cast<int>(slot)).dot(ray), RigAxis(k).dot(ray) - 1e-12);
      }
      const Vector3d in_view = rig.slots[slot].pano_from_view.transpose() * ray;
      ASSERT_LE(std::abs(in_view.x()), in_view.z() * (1 + 1e-12));
      ASSERT_LE(std::abs(in_view.y()), in_view.z() * (1 + 1e-12));
    }
  }
}

TEST(ColmapRig, IsAsFineAsTheWidestPanorama) {
  Scene scene = MakeBoxScene();
  scene.views[4].camera = EquirectangularCamera(4000, 2000);
  const Camera camera = RigFor(scene).camera;
  EXPECT_EQ(camera.fx, 637);  // ⌈4000 / 2π⌉
  EXPECT_EQ(camera.width, 2 * 637);
  EXPECT_EQ(camera.cy, 637);
}

TEST(ColmapRig, GivesPicturesOfARigDistinctPlainNames) {
  Scene scene = MakeBoxScene();
  scene.views.resize(4);
  scene.views[0].picture = "große Küche.JPG";
  scene.views[1].picture = "große_Küche.png";
  scene.views[2].picture = "a.b.jpeg";
  scene.views[3].picture = "große Küche.JPG";
  scene.views[3].camera = PinholeCamera(64, 48, 50, 50, 32, 24);
  EXPECT_THAT(RigPictureNames(scene), testing::ElementsAre("große_Küche.jpg", "große_Küche_2.jpg",
                                                           "a.b.jpg", "photos/große_Küche.JPG"));
}

TEST(ColmapRig, DescribesTheRigToOldAndNewPrograms) {
  const TempFolder temp;
  WriteRigConfig(temp / "rig_config.json", RigFor(MakeBoxScene()));
  const nlohmann::json rigs = ReadJsonFile(temp / "rig_config.json");
  ASSERT_EQ(rigs.size(), 1U);
  EXPECT_EQ(rigs[0]["ref_camera_id"], 1);
  ASSERT_EQ(rigs[0]["cameras"].size(), 10U);
  EXPECT_EQ(rigs[0]["cameras"][0]["ref_sensor"], true);
  EXPECT_FALSE(rigs[0]["cameras"][0].contains("cam_from_rig_rotation"));
  for (size_t k = 0; k < 10; ++k) {
    const nlohmann::json& camera = rigs[0]["cameras"][k];
    EXPECT_EQ(camera["camera_id"], k + 1);
    EXPECT_EQ(camera["image_prefix"], "view_" + std::to_string(k) + "/");
    const auto q = camera["rel_qvec"].get<std::vector<double>>();
    // Its axis, from the rig's first camera, which looks as the panorama does, is its z.
    const Matrix3d cam_from_ref = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
    EXPECT_LT((cam_from_ref * RigAxis(static_cast<int>(k)) - Vector3d::UnitZ()).norm(), 1e-12);
    if (k == 0) continue;
    EXPECT_EQ(camera["cam_from_rig_rotation"], camera["rel_qvec"]);
  }
}

}  // namespace
}  // namespace enfilade
