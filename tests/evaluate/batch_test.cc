// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/batch.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "enfilade/evaluate/report.h"

namespace enfilade {
namespace {

std::vector<JudgedHome> ThreeHomes() {
  std::vector<JudgedHome> homes(3);
  homes[0] = {"a", "", EmptyReport()};
  homes[0].figures["area_iou_net"] = 0.75;
  homes[0].figures["column_median_deg"] = 0.5;
  homes[0].figures["rooms_total"] = 4;
  homes[1] = {"b", "", EmptyReport()};
  homes[1].figures["area_iou_net"] = 0.25;
  homes[1].figures["column_median_deg"] = 0.25;
  homes[1].figures["rooms_total"] = 2;
  homes[2] = {"c, \"the\" third", "no | result", {}};
  return homes;
}

TEST(SummariseBatch, KnowsMeanAndWorstByTheFiguresSense) {
  const std::vector<FigureSummary> summaries = SummariseBatch(ThreeHomes());
  ASSERT_EQ(summaries.size(), 3u);
  EXPECT_EQ(summaries[0].key, "area_iou_net");
  EXPECT_EQ(summaries[0].num_homes, 2);
  EXPECT_EQ(summaries[0].mean, 0.5);
  EXPECT_EQ(summaries[0].worst, 0.25);
  EXPECT_EQ(summaries[0].worst_home, "b");
  EXPECT_EQ(summaries[1].key, "column_median_deg");
  EXPECT_EQ(summaries[1].worst, 0.5);
  EXPECT_EQ(summaries[1].worst_home, "a");
  EXPECT_EQ(summaries[2].key, "rooms_total");
  EXPECT_EQ(summaries[2].mean, 3);
  EXPECT_FALSE(summaries[2].worst);
}

TEST(SummariseBatch, NothingGivesNothing) {
  EXPECT_TRUE(SummariseBatch({}).empty());
  EXPECT_EQ(BatchToJson({}).at("failed"), 0);
}

TEST(BatchToJson, CountsWhatFailed) {
  const nlohmann::json json = BatchToJson(ThreeHomes());
  EXPECT_EQ(json.at("failed"), 1);
  EXPECT_EQ(json.at("homes").at(2).at("error"), "no | result");
  EXPECT_EQ(json.at("homes").at(0).at("figures").at("rooms_total"), 4);
  EXPECT_EQ(json.at("summary").at("area_iou_net").at("worst_home"), "b");
  EXPECT_TRUE(json.at("summary").at("rooms_total").at("worst").is_null());
}

TEST(BatchToCsv, QuotesNamesAndLeavesEmptyWhatIsNot) {
  const std::string csv = BatchToCsv(ThreeHomes());
  EXPECT_EQ(csv.find("name,error,area_iou_net,area_iou_gross,"), 0u);
  EXPECT_NE(csv.find("\r\na,,0.75,,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\r\n\"c, \"\"the\"\" third\",no | result,,"), std::string::npos) << csv;
}

TEST(BatchToMarkdown, NamesTheFailed) {
  const std::string text = BatchToMarkdown(ThreeHomes());
  EXPECT_EQ(text.find("3 homes, 1 of them failed.\n"), 0u) << text;
  EXPECT_NE(text.find("| `area_iou_net` | 0.5 | 0.25 | b | 2 |\n"), std::string::npos) << text;
  EXPECT_NE(text.find("| c, \"the\" third | no \\| result |\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace enfilade
