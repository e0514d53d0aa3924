// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/obj_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/exchange/obj_writer.h"
#include "enfilade/model/extrude.h"
#include "tests/support/model_checks.h"
#include "tests/support/plan_fixtures.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

TEST(ReadObj, IsTheInverseOfWriteObjButForTextures) {
  const TempFolder folder;
  Floorplan plan = MakePlan({MakeRoom(3, "0,0 4,0 4,3 2,3 2,2 0,2"), MakeRoom(7, "5,0 7,0 7,3")});
  plan.storeys[0].walls.pop_back();  // one wall that the plan does not list
  const BuildingModel model = ExtrudeFloorplan(plan);
  WriteObj(folder / "model.obj", model);
  const BuildingModel read = ReadObj(folder / "model.obj");
  ASSERT_EQ(read.faces.size(), model.faces.size());
  for (size_t i = 0; i < model.faces.size(); ++i) {
    const ModelFace &expected = model.faces[i], &face = read.faces[i];
    EXPECT_EQ(face.kind, expected.kind);
    EXPECT_EQ(face.storey_idx, expected.storey_idx);
    EXPECT_EQ(face.room_id, expected.room_id);
    EXPECT_EQ(face.wall_id, expected.wall_id);
    EXPECT_NEAR((face.normal - expected.normal).norm(), 0, 1e-6);
    ASSERT_EQ(face.triangles.size(), expected.triangles.size());
    for (size_t t = 0; t < face.triangles.size(); ++t) {
      for (size_t k = 0; k < 3; ++k) {
        const auto corner = [&](const ModelFace& f) {
          return f.vertices[static_cast<size_t>(f.triangles[t][k])];
        };
        EXPECT_NEAR((corner(face) - corner(expected)).norm(), 0, 1e-6);
      }
    }
  }
  ExpectWatertight(read);
}

TEST(ReadObj, RefusesWhatIsNoModelWithOneLine) {
  const TempFolder folder;
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (const std::string& text :
       {std::string(), triangle + "f 1 2 3\n", triangle + "g wall\nf 1 2 3\n",
        triangle + "g storey_0/room_0/floor\nf 1 2 4\n",
        triangle + "g storey_0/room_0/floor\nf 1 2 2\n",
        triangle + "g storey_0/room_99999999999999999999/floor\nf 1 2 3\n"}) {
    WriteFileAtomic(folder / "model.obj", text);
    try {
      (void)ReadObj(folder / "model.obj");
      FAIL() << text;
    } catch (const InvalidInputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("model.obj"));
    }
  }
  EXPECT_THROW((void)ReadObj(folder / "none.obj"), IoError);
}

}  // namespace
}  // namespace enfilade
