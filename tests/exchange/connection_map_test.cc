// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/connection_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "enfilade/exchange/connection_report.h"
#include "tests/exchange/connection_scenes.h"
#include "tests/exchange/parsed_map.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRounding_mm = 0.0015;

std::string Svg(const ReportedScene& reported) {
  return FormatConnectionsSvg(reported.scene, reported.Report());
}

double MmPerM(const pugi::xml_document& document) {
  for (const pugi::xml_node& line : Select(document, "//text[@class='sheet-line']")) {
    return 1000 / std::stod(std::string(line.child_value()).substr(std::strlen("Scale 1:")));
  }
  ADD_FAILURE() << "no scale";
  return 0;
}

TEST(FormatConnectionsSvg, CamerasAreTrueToScaleWithYUp) {
  const ReportedScene reported = MakeReportedScene({20, 8, 4});
  const auto document = ParseXml(Svg(reported));
  const double mm_per_m = MmPerM(document);
  const auto cameras = CamerasOf(document);
  ASSERT_EQ(cameras.size(), 32u);
  const View* first = nullptr;
  for (const View& view : reported.scene.views) {
    if (first == nullptr || first->component_idx != view.component_idx) first = &view;
    const Vector3d moved = view.world_from_cam.translation - first->world_from_cam.translation;
    const Vector2d drawn = cameras.at(view.picture) - cameras.at(first->picture);
    EXPECT_NEAR(drawn.x(), mm_per_m * moved.x(), kRounding_mm);
    EXPECT_NEAR(drawn.y(), -mm_per_m * moved.y(), kRounding_mm);
  }
  const pugi::xml_node bar = Select(document, "//g[@class='scale-bar']").at(0);
  const double first_m =
      std::stod(Select(document, "//g[@class='scale-bar']/text")[1].child_value());
  EXPECT_NEAR(bar.child("rect").attribute("width").as_double(), first_m * mm_per_m, kRounding_mm);
}

TEST(FormatConnectionsSvg, WedgesLookWhereThePictureDoes) {
  const ReportedScene reported = MakeThreeRooms();
  const auto document = ParseXml(Svg(reported));
  const auto wedges = Select(document, "//g[@id='cameras']/path[@class='wedge']");
  ASSERT_EQ(wedges.size(), 2u);  // none for the picture without a place
  for (size_t i = 0; i < 2; ++i) {
    Vector2d tip, right, left;
    ASSERT_EQ(std::sscanf(wedges[i].attribute("d").value(),
                          "M %lf %lf L %lf %lf A %*f %*f 0 0 0 %lf %lf Z", &tip.x(), &tip.y(),
                          &right.x(), &right.y(), &left.x(), &left.y()),
              6);
    const Vector2d middle = 0.5 * (right + left) - tip;
    const double yaw_deg = i == 0 ? 90 : -30;
    EXPECT_NEAR(RadToDeg(std::atan2(-middle.y(), middle.x())), yaw_deg, 0.1);
  }
}

TEST(FormatConnectionsSvg, LinesAreThePairsAndGrowWithTheirInliers) {
  ReportedScene reported;
  for (int i = 0; i < 5; ++i) {
    AddView(reported, "p" + std::to_string(i) + ".jpg", 0, {2.0 * i, 0.3 * i * i, 1.5}, 0);
  }
  AddPair(reported, 0, 1, PairVerdict::kAccepted, 300, 200);
  AddPair(reported, 1, 2, PairVerdict::kAccepted, 100, 50);
  AddPair(reported, 2, 3, PairVerdict::kSamePlace, 90, 20);
  AddPair(reported, 3, 4, PairVerdict::kAccepted, 30, 10);
  AddPair(reported, 0, 4, PairVerdict::kAgainstTriplets, 40, 12);
  AddPair(reported, 0, 3, PairVerdict::kAgainstPositions, 40, 14);
  AddPair(reported, 0, 2, PairVerdict::kChance, 40, 14);
  AddPair(reported, 1, 4, PairVerdict::kFewMatches, 9, 3);
  const auto document = ParseXml(Svg(reported));
  const auto cameras = CamerasOf(document);
  double narrower = 0;
  int inliers = 0;
  const auto ties = Select(document, "//line[@class='tie' and @data-a]");
  ASSERT_EQ(ties.size(), 4u);
  for (const pugi::xml_node& tie : ties) {
    EXPECT_GT(tie.attribute("data-inliers").as_int(), inliers);
    EXPECT_GT(tie.attribute("stroke-width").as_double(), narrower);
    inliers = tie.attribute("data-inliers").as_int();
    narrower = tie.attribute("stroke-width").as_double();
    const Vector2d a = cameras.at(tie.attribute("data-a").value());
    const Vector2d b = cameras.at(tie.attribute("data-b").value());
    EXPECT_EQ(tie.attribute("x1").as_double(), a.x());
    EXPECT_EQ(tie.attribute("y1").as_double(), a.y());
    EXPECT_EQ(tie.attribute("x2").as_double(), b.x());
    EXPECT_EQ(tie.attribute("y2").as_double(), b.y());
  }
  EXPECT_EQ(Select(document, "//line[@class='refused' and @data-a]").size(), 2u);
}

TEST(FormatConnectionsSvg, OfManyContradictionsTheStrongestAreDrawn) {
  ReportedScene reported;
  for (int i = 0; i < 12; ++i) {
    AddView(reported, std::to_string(i) + ".jpg", i / 8, {1.5 * (i % 4), 1.5 * (i / 4), 1.5}, 0);
  }
  std::vector<int> within;
  for (int a = 0; a < 12; ++a) {
    for (int b = a + 1; b < 12; ++b) {
      const int num_inliers = 10 + (37 * (12 * a + b)) % 101;
      AddPair(reported, a, b, PairVerdict::kAgainstTriplets, 200, num_inliers);
      if (a / 8 == b / 8) within.push_back(num_inliers);
    }
  }
  const auto document = ParseXml(Svg(reported));
  int num_between = 0, best_between = 0, most_between = 0;
  for (const PanoPair& pair : reported.pairs) {
    if (pair.a_idx / 8 == pair.b_idx / 8) continue;
    most_between = std::max(most_between, static_cast<int>(pair.inliers.size()));
  }
  const auto lines = Select(document, "//line[@class='refused' and @data-a]");
  for (const pugi::xml_node& line : lines) {
    if (line.attribute("data-a").as_int() / 8 == line.attribute("data-b").as_int() / 8) continue;
    ++num_between;
    best_between = line.attribute("data-inliers").as_int();
  }
  EXPECT_EQ(lines.size(), std::min<size_t>(40, within.size() + 1));
  EXPECT_EQ(num_between, 1);
  EXPECT_EQ(best_between, most_between);
}

TEST(FormatConnectionsSvg, NamesDoNotOverlapAndStayOnTheSheet) {
  for (const std::vector<int>& sizes : {std::vector{20, 8, 4}, {32}, {3, 1, 1, 1, 1, 1, 1, 1, 1}}) {
    const auto document = ParseXml(Svg(MakeReportedScene(sizes)));
    std::vector<Eigen::AlignedBox2d> boxes;
    for (const pugi::xml_node& node : Select(document, "//g[@id='names']/text")) {
      const Vector2d anchor(node.attribute("x").as_double(), node.attribute("y").as_double());
      const std::string style = node.attribute("class").value();
      // A narrow estimate of the letters, all of which are ASCII here.
      const double width = 0.5 * 2.2 * static_cast<double>(std::strlen(node.child_value()));
      const double left = style == "map-name name-start"    ? anchor.x()
                          : style == "map-name name-middle" ? anchor.x() - 0.5 * width
                                                            : anchor.x() - width;
      boxes.push_back({Vector2d(left, anchor.y() - 1.6), Vector2d(left + width, anchor.y())});
    }
    // All or nearly all find a place in such homes.
    const size_t num_views = MakeReportedScene(sizes).scene.views.size();
    EXPECT_GE(boxes.size(), num_views - 3);
    EXPECT_LE(boxes.size(), num_views);
    const pugi::xml_node svg = document.child("svg");
    const Eigen::AlignedBox2d sheet(Vector2d(8, 8),
                                    Vector2d(289, svg.attribute("height").as_double() - 8));
    for (size_t i = 0; i < boxes.size(); ++i) {
      EXPECT_TRUE(sheet.contains(boxes[i]));
      for (size_t k = 0; k < i; ++k) EXPECT_FALSE(boxes[i].intersects(boxes[k]));
    }
  }
}

TEST(FormatConnectionsSvg, PanelsHoldTheirCamerasAndDoNotOverlap) {
  for (const std::vector<int>& sizes :
       {std::vector{20, 8, 4}, {30, 2, 2, 2}, {5, 4, 3, 3, 2, 2, 2, 2, 2, 2, 2, 2, 1, 1}, {120}}) {
    const ReportedScene reported = MakeReportedScene(sizes);
    const auto document = ParseXml(Svg(reported));
    std::vector<Eigen::AlignedBox2d> panels;
    for (const pugi::xml_node& rect : Select(document, "//rect[@class='panel']")) {
      const Vector2d corner(rect.attribute("x").as_double(), rect.attribute("y").as_double());
      const Vector2d size(rect.attribute("width").as_double(),
                          rect.attribute("height").as_double());
      panels.push_back({corner, corner + size});
    }
    const bool has_list = sizes.back() == 1;
    const auto num_maps =
        static_cast<size_t>(std::ranges::count_if(sizes, [](int n) { return n > 1; }));
    ASSERT_EQ(panels.size(), num_maps + (has_list ? 1 : 0));
    for (size_t i = 0; i < panels.size(); ++i) {
      for (size_t k = 0; k < i; ++k) EXPECT_FALSE(panels[i].intersects(panels[k]));
    }
    for (const auto& circle : Select(document, "//circle[@data-picture]")) {
      const size_t component = circle.attribute("data-component").as_uint();
      const Vector2d at(circle.attribute("cx").as_double(), circle.attribute("cy").as_double());
      EXPECT_TRUE(panels[std::min(component, panels.size() - 1)].contains(at));
    }
  }
}

TEST(FormatConnectionsSvg, OfCrowdsNamesAndWeakContradictionsAreLeftOut) {
  const ReportedScene reported = MakeReportedScene({500});
  const auto document = ParseXml(Svg(reported));
  EXPECT_EQ(Select(document, "//g[@id='names']/text").size(), 0u);
  EXPECT_EQ(CamerasOf(document).size(), 500u);
  std::vector<int> contradictions;
  for (const PanoPair& pair : reported.pairs) {
    if (pair.verdict != PairVerdict::kAgainstTriplets &&
        pair.verdict != PairVerdict::kAgainstPositions) {
      continue;
    }
    contradictions.push_back(static_cast<int>(pair.inliers.size()));
  }
  std::ranges::sort(contradictions, std::ranges::greater{});
  contradictions.resize(40);
  std::vector<int> drawn;
  for (const auto& line : Select(document, "//line[@class='refused' and @data-a]")) {
    drawn.push_back(line.attribute("data-inliers").as_int());
  }
  EXPECT_EQ(drawn, contradictions);
}

TEST(FormatConnectionsSvg, FewAndStrangeScenesAreDrawn) {
  const ReportedScene none;
  EXPECT_TRUE(CamerasOf(ParseXml(Svg(none))).empty());
  ReportedScene one;
  AddView(one, "only.jpg", 0, {1e6, -1e6, 1.5}, 0);
  EXPECT_EQ(CamerasOf(ParseXml(Svg(one))).size(), 1u);
  // Two at one place, and two a hundred kilometres apart.
  for (const double distance_m : {0.0, 1e5}) {
    ReportedScene two = one;
    AddView(two, "other.jpg", 0, {1e6 + distance_m, -1e6, 1.5}, 0);
    AddPair(two, 0, 1, PairVerdict::kSamePlace, 50, 40);
    const auto document = ParseXml(Svg(two));
    const auto cameras = CamerasOf(document);
    EXPECT_NEAR((cameras.at("other.jpg") - cameras.at("only.jpg")).norm(),
                distance_m * MmPerM(document), kRounding_mm);
    EXPECT_LT(cameras.at("other.jpg").x(), 289);
  }
}

TEST(FormatConnectionsSvg, PointsAreDrawnWithTheirComponent) {
  ReportedScene reported = MakeThreeRooms();
  // Of the picture without a place.
  ScenePoint point;
  point.view_idx = {2};
  reported.scene.points.push_back(point);
  const auto document = ParseXml(Svg(reported));
  const double mm_per_m = MmPerM(document);
  const Vector2d hall = CamerasOf(document).at("hall.jpg");
  std::string drawn;
  for (const auto& path : Select(document, "//g[@id='panels']/path")) {
    drawn += path.attribute("d").value();
  }
  EXPECT_EQ(std::ranges::count(drawn, 'M'), 5);
  for (const char* at = std::strchr(drawn.c_str(), 'M'); at != nullptr;
       at = std::strchr(at + 1, 'M')) {
    Vector2d p;
    ASSERT_EQ(std::sscanf(at, "M%lf %lfh0", &p.x(), &p.y()), 2);
    // The points lie one metre apart, one metre north of the hall; cells are half a millimetre.
    const Vector2d moved = (p - hall) / mm_per_m;
    EXPECT_NEAR(moved.x(), std::round(moved.x()), 0.36 / mm_per_m);
    EXPECT_NEAR(moved.y(), -1, 0.36 / mm_per_m);
  }
}

TEST(FormatConnectionsSvg, InferredPosesAreHollow) {
  ReportedScene reported = MakeThreeRooms();
  reported.scene.views[1].is_pose_inferred = true;
  const auto document = ParseXml(Svg(reported));
  for (const pugi::xml_node& circle : Select(document, "//circle[@data-picture]")) {
    const bool is_kitchen = std::string(circle.attribute("data-picture").value()) == "kitchen.jpg";
    EXPECT_STREQ(circle.attribute("class").value(),
                 is_kitchen ? "camera camera-inferred" : "camera");
  }
}

}  // namespace
}  // namespace enfilade
