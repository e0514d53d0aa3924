// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/pixel_truth.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/exchange/floorplan_json.h"
#include "enfilade/exchange/ground_truth_reader.h"
#include "enfilade/exchange/npy.h"
#include "enfilade/image/codec.h"
#include "tests/support/plan_fixtures.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

TEST(PixelTruth, ReadsWhatIsRight) {
  const TempFolder folder;
  WriteImage(folder / "a.png", ImageU8(2, 4, 1, 3));
  EXPECT_EQ(ReadTruthLabels(folder / "a.png")(1, 3), 3);
  WriteNpy(folder / "depth.npy", ImageF(2, 4, 1, 1.5f));
  EXPECT_EQ(ReadTruthDepth(folder / "depth.npy")(0, 0), 1.5f);
  WriteNpy(folder / "normals.npy", Image<int8_t>(2, 4, 3, -127));
  EXPECT_EQ(ReadTruthNormals(folder / "normals.npy")(0, 0, 2), -127);
}

TEST(PixelTruth, RefusesWhatCannotBe) {
  const TempFolder folder;
  WriteImage(folder / "a.png", ImageU8(2, 4, 1, 4));
  EXPECT_THROW((void)ReadTruthLabels(folder / "a.png"), InvalidInputError);
  WriteImage(folder / "a.png", ImageU8(4, 4, 1, 1));
  EXPECT_THROW((void)ReadTruthLabels(folder / "a.png"), InvalidInputError);
  WriteFileAtomic(folder / "a.png", "cut");
  EXPECT_THROW((void)ReadTruthLabels(folder / "a.png"), InvalidInputError);
  for (const float bad :
       {-1.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    WriteNpy(folder / "a.npy", ImageF(2, 4, 1, bad));
    EXPECT_THROW((void)ReadTruthDepth(folder / "a.npy"), InvalidInputError);
  }
  WriteNpy(folder / "a.npy", ImageF(2, 4, 3, 1));
  EXPECT_THROW((void)ReadTruthDepth(folder / "a.npy"), InvalidInputError);
  WriteNpy(folder / "a.npy", Image<int8_t>(2, 4));
  EXPECT_THROW((void)ReadTruthNormals(folder / "a.npy"), InvalidInputError);
}

TEST(PixelTruth, IsNamedWhereItLiesBesideThePlan) {
  const TempFolder folder;
  Floorplan plan = MakePlan({MakeRoom(0, "0,0 4,0 4,3 0,3")});
  for (const char* picture : {"a.jpg", "b.jpg"}) {
    PlanCamera camera;
    camera.picture = picture;
    plan.cameras.push_back(camera);
  }
  WriteFloorplanJson(folder / "truth" / "floorplan.json", plan, nlohmann::json::object());
  WriteImage(folder / "truth" / "labels" / "a.png", ImageU8(2, 4, 1, 3));
  WriteNpy(folder / "truth" / "depth" / "b.npy", ImageF(2, 4));
  const GroundTruth truth = ReadGroundTruth(folder.path());
  ASSERT_EQ(truth.views.size(), 2u);
  EXPECT_EQ(truth.views[0].labels_path, folder / "truth" / "labels" / "a.png");
  EXPECT_TRUE(truth.views[0].depth_path.empty());
  EXPECT_TRUE(truth.views[0].normals_path.empty());
  EXPECT_TRUE(truth.views[1].labels_path.empty());
  EXPECT_EQ(truth.views[1].depth_path, folder / "truth" / "depth" / "b.npy");
}

}  // namespace
}  // namespace enfilade
