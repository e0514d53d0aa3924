// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/plan_svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>
#include <set>
#include <sstream>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "tests/support/plan_fixtures.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kRounding_mm = 0.0015;

pugi::xml_document Parse(const std::string& svg) {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_string(svg.c_str());
  EXPECT_TRUE(result) << result.description();
  return document;
}

// Millimetres of paper per metre as the file itself states them in its description.
double PaperMmPerM(const pugi::xml_document& document) {
  const std::string description = document.child("svg").child_value("desc");
  const size_t at = description.find("1:");
  EXPECT_NE(at, std::string::npos);
  return 1000.0 / std::stod(description.substr(at + 2));
}

Ring2 PathPoints(const pugi::xml_node& path) {
  Ring2 points;
  std::istringstream stream(path.attribute("d").value());
  std::string command;
  while (stream >> command && command != "Z") {
    Vector2d p;
    stream >> p.x() >> p.y();
    points.push_back(p);
  }
  return points;
}

std::vector<pugi::xml_node> OfClass(const pugi::xml_document& document, const std::string& style) {
  std::vector<pugi::xml_node> nodes;
  const std::string query = "//*[contains(concat(' ', @class, ' '), ' " + style + " ')]";
  for (const pugi::xpath_node& hit : document.select_nodes(query.c_str())) {
    nodes.push_back(hit.node());
  }
  return nodes;
}

Floorplan TwoRooms() {
  return MakePlan({MakeRoom(0, "0,0 4,0 4,3 0,3"), MakeRoom(1, "4.1,0 7,0 7,2 6,2 6,3 4.1,3")});
}

TEST(FormatPlanSvg, PageUnitsAreMillimetres) {
  const auto document = Parse(FormatPlanSvg(TwoRooms()));
  const pugi::xml_node svg = document.child("svg");
  EXPECT_STREQ(svg.attribute("width").value(), "297mm");
  EXPECT_STREQ(svg.attribute("height").value(), "210mm");
  EXPECT_STREQ(svg.attribute("viewBox").value(), "0 0 297 210");
}

TEST(FormatPlanSvg, RoomsAndWallsAreTrueToScale) {
  const Floorplan plan = TwoRooms();
  const auto document = Parse(FormatPlanSvg(plan));
  const double mm_per_m = PaperMmPerM(document);
  const auto rooms = OfClass(document, "room");
  ASSERT_EQ(rooms.size(), 2u);
  for (size_t i = 0; i < rooms.size(); ++i) {
    const Room& room = plan.storeys[0].rooms[i];
    const Ring2 points = PathPoints(rooms[i]);
    ASSERT_EQ(points.size(), room.polygon.outer.size());
    for (size_t k = 0; k < points.size(); ++k) {
      // Up in the plan is up on the sheet; lengths are kept in both directions.
      const Vector2d moved = room.polygon.outer[k] - room.polygon.outer[0];
      EXPECT_NEAR(points[k].x() - points[0].x(), mm_per_m * moved.x(), kRounding_mm);
      EXPECT_NEAR(points[k].y() - points[0].y(), -mm_per_m * moved.y(), kRounding_mm);
    }
    EXPECT_EQ(rooms[i].attribute("data-room").as_int(-1), room.id);
    EXPECT_NEAR(rooms[i].attribute("data-area-m2").as_double(), Area(room.polygon), 6e-4);
  }
  for (const pugi::xml_node& face : OfClass(document, "face")) {
    const Vector2d along(face.attribute("x2").as_double() - face.attribute("x1").as_double(),
                         face.attribute("y2").as_double() - face.attribute("y1").as_double());
    EXPECT_NEAR(along.norm(), mm_per_m * face.attribute("data-length-m").as_double(),
                2 * kRounding_mm);
  }
  EXPECT_EQ(OfClass(document, "face").size(), 10u);
}

TEST(FormatPlanSvg, DimensionsTellTheLengthsTheyAreDrawnWith) {
  const auto document = Parse(FormatPlanSvg(TwoRooms()));
  const double mm_per_m = PaperMmPerM(document);
  std::multiset<std::string> texts;
  for (const pugi::xml_node& group : OfClass(document, "dimension-group")) {
    const pugi::xml_node line = group.child("line");
    const double length =
        std::hypot(line.attribute("x2").as_double() - line.attribute("x1").as_double(),
                   line.attribute("y2").as_double() - line.attribute("y1").as_double());
    texts.insert(group.child_value("text"));
    EXPECT_NEAR(length / mm_per_m, std::stod(group.child_value("text")), 0.005 + 1e-4);
  }
  // Opposite walls of the rectangle tell their length once; then the L, and the whole.
  EXPECT_EQ(texts, (std::multiset<std::string>{"4.00", "3.00", "2.90", "3.00", "2.00", "1.90",
                                               "1.00", "1.00", "7.00", "3.00"}));
}

TEST(FormatPlanSvg, DimensionsHaveStandardDeviationsWhereTheyFindRoom) {
  Floorplan plan = TwoRooms();
  for (Wall& wall : plan.storeys[0].walls) wall.sigma_m = wall.length_sigma_m = 0.03;
  std::set<std::string> texts;
  const auto document = Parse(FormatPlanSvg(plan));
  for (const pugi::xml_node& group : OfClass(document, "dimension-group"))
    texts.insert(group.child_value("text"));
  EXPECT_TRUE(texts.contains("4.00 ± 0.03 m"));
  for (const char* length : {"3.00", "2.90", "2.00", "1.90", "1.00"}) {
    const auto tells = [&](const std::string& text) { return text.starts_with(length); };
    EXPECT_TRUE(std::any_of(texts.begin(), texts.end(), tells)) << length;
  }
}

TEST(FormatPlanSvg, LetteringDoesNotOverlap) {
  std::vector<Room> rooms;
  for (int i = 0; i < 12; ++i) {
    Room room = MakeRoom(i, "0,0 2.2,0 2.2,1.3 1.4,1.3 1.4,2 0,2");
    for (Vector2d& p : room.polygon.outer)
      p = (0.4 + 0.1 * i) * p + Vector2d(5 * (i % 4), 4 * (i / 4));
    rooms.push_back(room);
  }
  const auto document = Parse(FormatPlanSvg(MakePlan(rooms)));
  struct Text {
    Eigen::AlignedBox2d box;
    std::string text;
  };
  std::vector<Text> texts;
  for (const std::string style :
       {"dimension-text", "room-name", "room-area", "room-height", "room-small"}) {
    for (const pugi::xml_node& node : OfClass(document, style)) {
      if (std::string_view(node.name()) != "text") continue;
      const Vector2d anchor(node.attribute("x").as_double(), node.attribute("y").as_double());
      const double size = style == "room-name" ? 2.6 : 1.7;
      const double half_width = 0.28 * size * static_cast<double>(std::strlen(node.child_value()));
      const bool is_turned =
          std::string_view(node.attribute("transform").value()).starts_with("rotate(-90");
      Eigen::AlignedBox2d box;
      box.extend(is_turned ? Vector2d(anchor.x() - 0.7 * size, anchor.y() - half_width)
                           : Vector2d(anchor.x() - half_width, anchor.y() - 0.7 * size));
      box.extend(is_turned ? Vector2d(anchor.x(), anchor.y() + half_width)
                           : Vector2d(anchor.x() + half_width, anchor.y()));
      texts.push_back({box, node.child_value()});
    }
  }
  ASSERT_GT(texts.size(), 24u);
  for (size_t i = 0; i < texts.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      EXPECT_FALSE(texts[i].box.intersects(texts[j].box))
          << texts[i].text << " and " << texts[j].text;
    }
  }
}

TEST(FormatPlanSvg, WallBodiesFillTheSpaceBetweenInnerAndOuterFaces) {
  const auto document = Parse(FormatPlanSvg(MakePlan({MakeRoom(0, "0,0 4,0 4,3 0,3")}, 0.2)));
  const double mm_per_m = PaperMmPerM(document);
  double area_mm2 = 0;
  for (const pugi::xml_node& body : OfClass(document, "body")) {
    std::istringstream rings(body.attribute("d").value());
    std::string ring_text;
    while (std::getline(rings, ring_text, 'M')) {
      if (ring_text.empty()) continue;
      pugi::xml_document holder;
      pugi::xml_node path = holder.append_child("path");
      path.append_attribute("d") = ("M" + ring_text).c_str();
      // Outer rings and holes turn in opposite ways.
      area_mm2 += SignedArea(PathPoints(path));
    }
  }
  EXPECT_NEAR(std::abs(area_mm2) / (mm_per_m * mm_per_m), 4.4 * 3.4 - 4 * 3, 1e-3);
}

TEST(FormatPlanSvg, InferredWallsAreDashed) {
  Floorplan plan = TwoRooms();
  plan.storeys[0].walls[2].seen = WallSeen::kInferred;
  const auto document = Parse(FormatPlanSvg(plan));
  const auto dashed = OfClass(document, "face-inferred");
  ASSERT_EQ(dashed.size(), 1u);
  EXPECT_EQ(dashed[0].attribute("data-wall").as_int(-1), 2);
  EXPECT_STREQ(dashed[0].attribute("data-seen").value(), "inferred");
  EXPECT_EQ(OfClass(document, "body-inferred").size(), 1u);
}

TEST(FormatPlanSvg, DoorsCutTheWall) {
  Floorplan plan = TwoRooms();
  Opening door;
  door.wall_id = 1;
  door.a = {4, 1};
  door.b = {4, 1.9};
  door.other_room_id = 1;
  plan.storeys[0].openings.push_back(door);
  const auto closed = Parse(FormatPlanSvg(TwoRooms())), open = Parse(FormatPlanSvg(plan));
  EXPECT_EQ(OfClass(open, "door").size(), 1u);
  EXPECT_NE(std::string(OfClass(closed, "body")[0].attribute("d").value()),
            OfClass(open, "body")[0].attribute("d").value());
}

TEST(FormatPlanSvg, ScaleIsTheLargestThatFits) {
  const auto scale_of = [](double side_m) {
    Room room = MakeRoom(0, "0,0 1,0 1,1 0,1");
    for (Vector2d& p : room.polygon.outer) p *= side_m;
    return std::lround(1000 / PaperMmPerM(Parse(FormatPlanSvg(MakePlan({room})))));
  };
  EXPECT_EQ(scale_of(5), 50);
  EXPECT_EQ(scale_of(15), 100);
  EXPECT_EQ(scale_of(40), 200);
  EXPECT_EQ(scale_of(100), 500);
  EXPECT_EQ(scale_of(1000), 1000);
}

TEST(FormatPlanSvg, StoreysHaveTheirOwnLayersAndDoNotOverlap) {
  Floorplan plan = TwoRooms();
  plan.storeys.push_back(plan.storeys[0]);
  plan.storeys[1].id = 1;
  const auto document = Parse(FormatPlanSvg(plan));
  std::set<std::string> layers;
  for (const pugi::xpath_node& hit : document.select_nodes("//g[@inkscape:groupmode='layer']")) {
    EXPECT_TRUE(layers.insert(hit.node().attribute("id").value()).second);
  }
  for (const char* storey : {"storey-0", "storey-1"}) {
    for (const char* layer :
         {"", "-rooms", "-walls", "-openings", "-dimensions", "-labels", "-cameras"}) {
      EXPECT_TRUE(layers.contains(std::string(storey) + layer)) << storey << layer;
    }
  }
  const auto rooms = OfClass(document, "room");
  ASSERT_EQ(rooms.size(), 4u);
  std::vector<Eigen::AlignedBox2d> boxes(4);
  for (size_t i = 0; i < 4; ++i) {
    for (const Vector2d& p : PathPoints(rooms[i])) boxes[i].extend(p);
  }
  for (int i : {0, 1}) {
    for (int j : {2, 3}) EXPECT_FALSE(boxes[i].intersects(boxes[j]));
  }
}

TEST(FormatPlanSvg, OddPictureNamesAndTitlesStayWellFormed) {
  Floorplan plan = TwoRooms();
  PlanCamera camera;
  camera.picture = "a<\"&\xFF\x01.jpg";
  camera.world_from_cam.translation = {1, 1, 1.5};
  plan.cameras.push_back(camera);
  const std::string svg = FormatPlanSvg(plan, {.title = "Tom & <Jerry>\n"});
  EXPECT_TRUE(IsValidUtf8(svg));
  const auto document = Parse(svg);
  EXPECT_EQ(OfClass(document, "camera").size(), 1u);
  EXPECT_THAT(svg, testing::HasSubstr("12.00 m²"));
}

TEST(FormatPlanSvg, EmptyPlanIsAnEmptySheet) {
  EXPECT_TRUE(OfClass(Parse(FormatPlanSvg({})), "room").empty());
  EXPECT_TRUE(OfClass(Parse(FormatPlanSvg(MakePlan({}))), "room").empty());
}

TEST(WritePlanSvg, WritesTheTextOrNothing) {
  const TempFolder folder;
  WritePlanSvg(folder / "plan.svg", TwoRooms());
  EXPECT_EQ(ReadFile(folder / "plan.svg"), FormatPlanSvg(TwoRooms()));
  WriteFileAtomic(folder / "file", "x");
  EXPECT_THROW(WritePlanSvg(folder / "file" / "plan.svg", TwoRooms()), IoError);
}

}  // namespace
}  // namespace enfilade
