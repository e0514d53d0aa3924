// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

namespace enfilade {
namespace {

TEST(FigureInfos, KeysAreUniqueAndGroupsTogether) {
  std::set<std::string_view> keys, closed_groups;
  std::string_view group;
  for (const FigureInfo& info : FigureInfos()) {
    EXPECT_TRUE(keys.insert(info.key).second) << info.key;
    if (info.group != group) {
      EXPECT_TRUE(closed_groups.insert(info.group).second) << info.group;
    }
    group = info.group;
  }
}

TEST(FormatReport, ShowsUnitsAndLeavesOutEmptyGroups) {
  MetricReport report = EmptyReport();
  report["area_iou_net"] = 0.8904;
  report["rooms_total"] = 15;
  report["wall_plan_to_truth_median_m"] = 0.0382;
  report["column_median_deg"] = 0.581;
  const std::string table = FormatReport(report);
  EXPECT_NE(table.find("area_iou_net                      0.890\n"), std::string::npos) << table;
  EXPECT_NE(table.find("area_iou_gross                      n/a\n"), std::string::npos) << table;
  EXPECT_NE(table.find("wall_plan_to_truth_median_m       0.038 m\n"), std::string::npos) << table;
  EXPECT_NE(table.find("column_median_deg                  0.58 °\n"), std::string::npos) << table;
  EXPECT_NE(table.find("rooms_total                          15\n"), std::string::npos) << table;
  EXPECT_EQ(table.find("pose"), std::string::npos) << table;
}

TEST(FormatReport, ShowsUnknownKeysLast) {
  const std::string table = FormatReport({{"mine", 0.5}, {"area_iou_net", 1.0}});
  EXPECT_EQ(table,
            "area\n  area_iou_net                      1.000\nother\n"
            "  mine                              0.500\n");
}

TEST(ReportToJson, CountsAreIntegersAndNoneIsNull) {
  const nlohmann::json json =
      ReportToJson({{"rooms_total", 15.0}, {"area_iou_net", 0.5}, {"seconds", {}}});
  EXPECT_EQ(json.dump(), R"({"area_iou_net":0.5,"rooms_total":15,"seconds":null})");
}

TEST(ReportToJson, ListsThePanoramas) {
  EvaluationReport report;
  report.figures = EmptyReport();
  report.pictures = {"a.jpg"};
  report.columns.panoramas.push_back({"a.jpg", 900, 0.5, {}, {}, 0.75, 0.875, {}, {}});
  const nlohmann::json json = ReportToJson(report);
  EXPECT_TRUE(json.at("column_median_deg").is_null());
  ASSERT_EQ(json.at("panoramas").size(), 1U);
  EXPECT_EQ(json["panoramas"][0]["picture"], "a.jpg");
  EXPECT_EQ(json["panoramas"][0]["within_10pct"], 0.875);
  EXPECT_TRUE(json["panoramas"][0]["iou"].is_null());
}

}  // namespace
}  // namespace enfilade
