// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/wall_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pugixml.hpp>

#include "tests/support/plan_fixtures.h"

namespace enfilade {
namespace {

using testing::HasSubstr;
using testing::Not;

// The wall x = 4 of a room of 4 × 3 m, seen from its middle in three columns of which one looks
// past it.
struct Asked {
  Floorplan plan = MakePlan({MakeRoom(0, "0,0 4,0 4,3 0,3"), MakeRoom(1, "4.1,0 7,0 7,3 4.1,3")});
  Scene scene;
  WallExplanation why;

  Asked() {
    View view;
    view.picture = "middle.jpg";
    view.world_from_cam.translation = {2, 1.5, 1.4};
    scene.views.push_back(view);
    why.wall = plan.storeys[0].walls[1];
    why.wall.sigma_m = 0.034;
    why.wall.length_sigma_m = 0.05;
    why.sigma = {{3, 0.94, 5.1, true, 1}, 2, 0.033, 0.02, 0.034};
    WallWitness witness{0, 2, 2.1, 0.4, 2.0 / 3, 0.012, {}};
    for (const double profile_m : {2.0, 2.02, 5.0})
      witness.sightings.push_back({1.5, 2, 0, profile_m});
    why.witnesses.push_back(witness);
    why.behind = WallBehind{7, 1, 0.1};
    why.cost = {3, 0.2, 0.01, 0, 1, 0.53};
  }
};

TEST(FormatWallReport, TellsTheEvidence) {
  const Asked asked;
  const std::string text = FormatWallReport(asked.scene, asked.why);
  for (const char* part :
       {"wall 1 of room 0, storey 0: seen along 94 % of its length", "3.00 ± 0.05 m long",
        "offset ± 0.034 m: ± 0.033 m for a wall from 2.0 m away; 2 % that the line is another",
        "5.1 m of other walls lie on its line, a room ends a wall's thickness behind it, 1 "
        "panorama "
        "agrees",
        "behind it, 0.10 m away: wall 7 of room 1", "seen by 1 panorama in 3 columns, 0 points",
        "middle.jpg", "23°", "67 %", "+0.012 m",
        "0.53 m (0.20 m unseen, 0.010 m² free outside, 0.000 m² solid inside, 1 corner)",
        "leave it no other place"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
  EXPECT_EQ(text.back(), '\n');
}

TEST(FormatWallReport, TellsWhatThePlanCostsWithoutTheWall) {
  Asked asked;
  asked.why.next_best = NextBestWall{-0.6, asked.why.cost, {3, 3, 0, 0, 4, 4}};
  EXPECT_THAT(FormatWallReport(asked.scene, asked.why),
              HasSubstr("moved 0.60 m into the room, its next best place"));
}

TEST(FormatWallReport, SaysWhenNobodySeesTheWall) {
  Asked asked;
  asked.why.witnesses.clear();
  asked.why.sigma.distance_m = 0;
  const std::string text = FormatWallReport(asked.scene, asked.why);
  EXPECT_THAT(text, HasSubstr("a wall that no panorama sees"));
  EXPECT_THAT(text, HasSubstr("seen by 0 panoramas in 0 columns"));
  EXPECT_THAT(text, Not(HasSubstr("incidence")));
}

TEST(FormatWallSvg, DrawsTheWallItsWitnessesAndWhereTheyHaveIt) {
  const Asked asked;
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(FormatWallSvg(asked.plan, asked.scene, asked.why).c_str()));
  const auto count = [&](const char* query) { return document.select_nodes(query).size(); };
  EXPECT_EQ(count("//*[@class='face-asked']"), 1U);
  EXPECT_EQ(count("//*[@class='agrees']"), 2U);
  EXPECT_EQ(count("//*[@class='disagrees']"), 1U);
  EXPECT_EQ(count("//*[@class='camera']"), 1U);
  EXPECT_EQ(count("//*[@class='next-best']"), 0U);
  // 1:50, the room with 0.6 m around it.
  EXPECT_EQ(document.child("svg").attribute("width").value(), std::string("104mm"));
  const pugi::xml_node wall = document.select_node("//*[@class='face-asked']").node();
  EXPECT_NEAR(wall.attribute("x1").as_double(), 20 * 4.6, 0.01);
  EXPECT_NEAR(wall.attribute("y1").as_double(), 20 * 3.6, 0.01);
  EXPECT_NEAR(wall.attribute("y2").as_double(), 20 * 0.6, 0.01);
}

}  // namespace
}  // namespace enfilade
