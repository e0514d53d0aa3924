// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/exchange/posed_folder.h"

namespace enfilade {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class PoseCsvTest : public PoseFormatTest {
 protected:
  std::string Refusal(const std::string& text) {
    WriteFileAtomic(folder / "poses.csv", text);
    return SceneRefusal(folder);
  }
};

constexpr char kHeader[] = "file,x,y,z,qw,qx,qy,qz\n";

TEST_F(PoseCsvTest, ReadsPoses) {
  // A quarter turn about x takes camera axes to an upright camera that looks along +y.
  WriteFileAtomic(folder / "poses.csv",
                  "\xEF\xBB\xBF# made by hand\r\nfile, x,y,z,qw,qx,qy,qz,note\r\n"
                  "a.png, 1.5 ,-2,1.6,0.7071068,-0.7071068,0,0,hall\r\n\r\n"
                  "\"images/b.png\",0,0,1e0,1.4142136e0,-1.4142136,0,0,\"x, y\"");
  EXPECT_THAT(SceneRefusal(folder), HasSubstr("has not length 1 (line 5)"));
  WriteFileAtomic(folder / "poses.csv", std::string(kHeader) +
                                            "a.png, 1.5 ,-2,1.6,0.7071068,-0.7071068,0,0\r\n\r\n"
                                            "\"images/b.png\",0,0,1e0,0.7071,-0.7071,0,0");
  const SceneReadReport report = ReadTestScene(folder);
  EXPECT_THAT(report.warnings, IsEmpty());
  EXPECT_EQ(report.scene.pose_source, PoseSource::kCsv);
  const View& view = ViewOf(report.scene, "a.png");
  EXPECT_EQ(view.world_from_cam.translation, Eigen::Vector3d(1.5, -2, 1.6));
  EXPECT_TRUE(view.world_from_cam.rotation.isApprox(UprightRotation(), 1e-6));
}

TEST_F(PoseCsvTest, RefusesBrokenFiles) {
  EXPECT_THAT(Refusal(""), HasSubstr("is empty"));
  EXPECT_THAT(Refusal("\n\n# x\n"), HasSubstr("is empty"));
  EXPECT_THAT(Refusal("file,x,y,z,qw,qx,qy\n"), HasSubstr("no column 'qz' (line 1)"));
  EXPECT_THAT(Refusal(std::string(500, '\0')), HasSubstr("no column 'file'"));
  EXPECT_THAT(Refusal(kHeader), HasSubstr("has no poses"));
  const std::string header = kHeader;
  EXPECT_THAT(Refusal(header + "a.png,0,0,0,1,0,0\n"), HasSubstr("too few fields (line 2)"));
  EXPECT_THAT(Refusal(header + ",0,0,0,1,0,0,0\n"), HasSubstr("names no picture"));
  EXPECT_THAT(Refusal(header + "a.png,0,x,0,1,0,0,0\n"), HasSubstr("'x' is no number for y"));
  EXPECT_THAT(Refusal(header + "a.png,0,nan,0,1,0,0,0\n"), HasSubstr("'nan' is no number"));
  EXPECT_THAT(Refusal(header + "a.png,0,inf,0,1,0,0,0\n"), HasSubstr("'inf' is no number"));
  EXPECT_THAT(Refusal(header + "a.png,0,1e999,0,1,0,0,0\n"), HasSubstr("no number"));
  EXPECT_THAT(Refusal(header + "a.png,0,,0,1,0,0,0\n"), HasSubstr("'' is no number"));
  EXPECT_THAT(Refusal(header + "a.png,0,0,0,0,0,0,0\n"), HasSubstr("length 1"));
  EXPECT_THAT(Refusal(header + "gone.png,0,0,0,1,0,0,0\n"), HasSubstr("absent: gone.png"));
}

}  // namespace
}  // namespace enfilade
