// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/gather_evidence.h"

#include <gtest/gtest.h>

#include <numeric>

namespace enfilade {
namespace {

// Two storeys, a camera each at (0, 0); every profile sees a wall at 1 m all round.
struct TwoStoreys {
  TwoStoreys() {
    for (int i = 0; i < 2; ++i) {
      View view;
      view.camera = EquirectangularCamera(64, 32);
      view.world_from_cam.rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
      view.world_from_cam.translation = {0, 0, 1.4 + 3 * i};
      view.storey_idx = i;
      scene.views.push_back(view);
      structure.storeys.push_back({3.0 * i, 2.5 + 3 * i, 0});
      WallProfile profile;
      profile.view_idx = i;
      profile.floor_z = 3.0 * i;
      profile.ceiling_z = 2.5 + 3 * i;
      profile.wall_m.assign(64, 1);
      profile.obstacle_m.assign(64, 1);
      profile.confidence.assign(64, 1);
      profile.is_seen.assign(64, 1);
      profile.wall_probability = ImageF(64, 3);
      for (int c = 0; c < 64; ++c) profile.wall_probability(c, 1) = 1;
      structure.profiles.push_back(profile);
    }
    structure.bin_m = {0.5, 1, 2};
  }

  void AddPoint(const Eigen::Vector3d& position, const Eigen::Vector3d& normal,
                std::vector<int> views) {
    scene.points.push_back({position, normal, {0, 0, 0}, std::move(views), {}});
  }

  [[nodiscard]] std::vector<EvidenceGrids> Counts() const {
    RunContext context(1);
    GatheredEvidence gathered = EvidenceOf(scene, structure, {}, EvidenceMode::kCounts, context);
    EXPECT_EQ(gathered.reason, "");
    return std::move(gathered.storeys);
  }

  Scene scene;
  Structure structure;
};

// How much more there is along the x axis than without points.
float Added(const ImageF& with, const ImageF& without) {
  float sum = 0;
  for (size_t i = 0; i < with.data().size(); ++i) sum += with.data()[i] - without.data()[i];
  return sum;
}

TEST(EvidenceOf, FloorPointsGiveRaysUpToTheirFootAndNoWall) {
  const std::vector<EvidenceGrids> without = TwoStoreys().Counts();
  for (const double z : {-0.1, 0.0, 0.1}) {  // noise lies on both sides of the floor
    TwoStoreys home;
    home.AddPoint({0.9, 0, z}, {0, 0, 1}, {0});
    const std::vector<EvidenceGrids> with = home.Counts();
    EXPECT_EQ(Added(with[0].wall, without[0].wall), 0);
    // 0.9 m less the margin of 0.05 m, in cells of 0.025 m.
    EXPECT_NEAR(Added(with[0].free, without[0].free), 0.85 / 0.025, 1.01);
    EXPECT_EQ(Added(with[1].free, without[1].free), 0);
  }
}

TEST(EvidenceOf, WallPointsGiveBothAndFurnitureRaysAlone) {
  const std::vector<EvidenceGrids> without = TwoStoreys().Counts();
  TwoStoreys home;
  home.AddPoint({0.9, 0, 1}, {-1, 0, 0}, {0});
  home.AddPoint({0.5, 0, 0.8}, {0, 0, 1}, {0});  // a table
  const std::vector<EvidenceGrids> with = home.Counts();
  EXPECT_EQ(Added(with[0].wall, without[0].wall), 1);
  EXPECT_NEAR(Added(with[0].free, without[0].free), (0.85 + 0.45) / 0.025, 2.01);
}

TEST(EvidenceOf, RaysFromOtherStoreysDoNotCrossAPlan) {
  const std::vector<EvidenceGrids> without = TwoStoreys().Counts();
  TwoStoreys home;
  // The lower ceiling and the upper floor, 0.5 m apart: each is within reach of the other storey.
  home.AddPoint({0.9, 0, 2.75}, {0, 0, 1}, {1});
  home.AddPoint({0.9, 0, 2.75}, {0, 0, -1}, {0});
  const std::vector<EvidenceGrids> with = home.Counts();
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(Added(with[i].free, without[i].free), 0.85 / 0.025, 1.01);
    EXPECT_EQ(Added(with[i].wall, without[i].wall), 0);
  }
}

}  // namespace
}  // namespace enfilade
