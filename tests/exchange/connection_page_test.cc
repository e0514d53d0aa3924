// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/connection_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "enfilade/base/errors.h"
#include "enfilade/exchange/connection_report.h"
#include "tests/exchange/connection_scenes.h"
#include "tests/exchange/parsed_map.h"

namespace enfilade {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string Html(const ReportedScene& reported) {
  return FormatConnectionsHtml(reported.scene, reported.Report());
}

TEST(FormatConnectionsHtml, NamesAreEscapedEverywhere) {
  const std::vector<std::string> names = {"<script>alert(\"1\")</script>.jpg", "a&b's.jpg",
                                          "Küche – größer ≥ 2.jpg", "tab\there\x01.jpg"};
  ReportedScene reported;
  for (size_t i = 0; i < names.size(); ++i) {
    AddView(reported, names[i], 0, {2.0 * static_cast<double>(i), 1, 1.5}, 0);
  }
  for (int i = 1; i < 4; ++i) AddPair(reported, i - 1, i, PairVerdict::kAccepted, 60, 30);
  reported.warnings = {"1 < 2 & \"x\""};
  const std::string html = Html(reported);
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_TRUE(IsValidUtf8(html));
  const auto page = ParseXml(html);
  const auto cameras = CamerasOf(page);
  for (const std::string& name : names) {
    const std::string shown = PrintablePath(name);
    const auto cells = Select(page, "//td/span[@class='name']");
    const bool is_in_table = std::ranges::any_of(
        cells, [&](const pugi::xml_node& cell) { return shown == cell.child_value(); });
    EXPECT_TRUE(is_in_table) << shown;
    EXPECT_TRUE(cameras.count(shown) == 1) << shown;
  }
  EXPECT_STREQ(Select(page, "//li").at(0).child_value(), "1 < 2 & \"x\"");
}

TEST(FormatConnectionsHtml, NeedsNoOtherFileAndHoldsTheDrawing) {
  const ReportedScene reported = MakeReportedScene({20, 8, 4});
  const std::string html = Html(reported);
  EXPECT_TRUE(html.starts_with("<!DOCTYPE html>"));
  const auto page = ParseXml(html);
  EXPECT_EQ(Select(page, "//@src | //@href | //script | //link").size(), 0u);
  EXPECT_EQ(Select(page, "//figure//circle[@data-picture]").size(), 32u);
  // A browser takes <td/> for the beginning of a cell.
  for (const pugi::xml_node& node : Select(page, "//td | //th | //span | //div | //li | //p")) {
    EXPECT_TRUE(node.first_child()) << node.name();
  }
}

TEST(FormatConnectionsHtml, TablesListViewsTiesAndRefusals) {
  const ReportedScene reported = MakeReportedScene({10, 4, 1});
  const auto page = ParseXml(Html(reported));
  const auto tables = Select(page, "//table");
  ASSERT_EQ(tables.size(), 3u);
  const auto num_rows = [&](size_t table) {
    const auto rows = tables[table].child("tbody").children("tr");
    return std::distance(rows.begin(), rows.end());
  };
  long num_ties = 0, num_refused = 0;
  for (const PanoPair& pair : reported.pairs) {
    const bool is_tie = pair.verdict == PairVerdict::kAccepted;
    num_ties += is_tie;
    num_refused += !is_tie && pair.num_matches >= 8;
  }
  EXPECT_EQ(num_rows(0), 15);
  EXPECT_EQ(num_rows(1), num_ties);
  EXPECT_EQ(num_rows(2), num_refused);
}

TEST(FormatConnectionsHtml, OnlyTheFirstOfManyRefusedPairsAreListed) {
  const ReportedScene reported = MakeReportedScene({24, 20});
  const auto page = ParseXml(Html(reported));
  const auto rows = Select(page, "//table").at(2).child("tbody").children("tr");
  EXPECT_EQ(std::distance(rows.begin(), rows.end()), 200);
}

TEST(FormatConnectionsHtml, TellsHowManyPairsWereNotMatched) {
  ReportedScene reported = MakeThreeRooms();
  EXPECT_THAT(Html(reported), Not(HasSubstr("Not matched")));
  reported.pairs.resize(1);
  EXPECT_THAT(Html(reported), HasSubstr("Not matched: 2 pairs"));
}

TEST(FormatConnectionsHtml, SaysWhereToTakeOneMorePicture) {
  ReportedScene reported = MakeThreeRooms();
  AddView(reported, "shed.jpg", 2, {0, 0, 1.5}, 0);
  AddView(reported, "garage1.jpg", 3, {0, 0, 1.5}, 0);
  AddView(reported, "garage2.jpg", 3, {2, 0, 1.5}, 0);
  AddView(reported, "barn.jpg", 4, {0, 0, 1.5}, 0);
  AddPair(reported, 3, 4, PairVerdict::kAgainstTriplets, 90, 80);
  AddPair(reported, 4, 5, PairVerdict::kAccepted, 60, 40);
  AddPair(reported, 1, 5, PairVerdict::kFewMatches, 12, 0);
  const std::string html = Html(reported);
  // Contradictions are no hint where another pair has something in common.
  EXPECT_THAT(html, HasSubstr("Component 3 (2 pictures) is not tied to the others. Its picture "
                              "garage2.jpg has most in common with kitchen.jpg (12 matches, 0 of "
                              "them agree)"));
  EXPECT_THAT(html, HasSubstr("attic.jpg is not tied to the others. It has most in common with "
                              "hall.jpg (30 matches, 9 of them agree): take one more picture "
                              "between the two, best in the doorway."));
  EXPECT_THAT(html, HasSubstr("shed.jpg is not tied to the others. It has most in common with "
                              "garage1.jpg (90 matches, 80 of them agree)"));
  EXPECT_THAT(html, HasSubstr("barn.jpg has nothing in common with the others."));
  EXPECT_THAT(html, HasSubstr("What agrees may agree by chance."));
  EXPECT_THAT(html, HasSubstr("tied to nothing"));
  EXPECT_THAT(html, HasSubstr("hangs on one pair"));
}

TEST(FormatConnectionsHtml, NoViewsMakeAPageWithoutRows) {
  EXPECT_EQ(Select(ParseXml(Html({})), "//td").size(), 0u);
}

TEST(FormatConnectionsHtml, OneComponentNeedsNoAdvice) {
  const ReportedScene reported = MakeReportedScene({12});
  EXPECT_THAT(Html(reported), Not(HasSubstr("What to do</h2>")));
}

}  // namespace
}  // namespace enfilade
