// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/comparison_page.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "tests/support/plan_fixtures.h"

namespace enfilade {
namespace {

using testing::HasSubstr;
using testing::Not;

ComparisonPage MakePage() {
  ComparisonPage page;
  page.title = "<home> & \"co\"";
  page.num_panoramas = 1;
  page.truth = MultiPolygon2{{ParseRing("0,0 4,0 4,3 0,3"), {}}};
  page.cameras = {{1, 2}};
  page.inside_picture = "a<b>.jpg";
  page.inside_photo_jpeg = "photo";
  ComparedMethod full;
  full.name = "full";
  full.title = "full solver";
  full.outcome = MethodOutcome::kFound;
  full.plan = MakePlan({MakeRoom(0, "0,0 4,0 4,3 0,3", {"1,1 1,2 2,2 2,1"})});
  full.figures = {{"area_error_gross", 0.031}, {"rooms", 1.0}, {"seconds", 2.0}};
  full.outside_jpeg = "outside";
  full.inside_jpeg = "inside";
  ComparedMethod late;
  late.name = "late";
  late.title = "a rival";
  late.outcome = MethodOutcome::kOutOfTime;
  late.reason = "not done after <1> s";
  late.figures = {{"seconds", 1.0}, {"peak_memory_mb", 50.0}};
  page.methods = {full, late};
  page.labels.superpixels = 0.96;
  page.labels.sheets = {{"x&y.jpg", "p", "1", "2", "3", "o"}};
  return page;
}

pugi::xml_document Parsed(const std::string& html) {
  pugi::xml_document document;
  const pugi::xml_parse_result result =
      document.load_string(html.c_str(), pugi::parse_full | pugi::parse_ws_pcdata);
  EXPECT_TRUE(result) << result.description() << " at "
                      << html.substr(
                             static_cast<size_t>(std::max<ptrdiff_t>(0, result.offset - 60)), 120);
  return document;
}

TEST(ComparisonPage, IsWellFormedAndNeedsNoNetwork) {
  const std::string html = FormatComparisonPage(MakePage());
  const pugi::xml_document document = Parsed(html);
  EXPECT_STREQ(document.child("html").child("head").child("title").text().get(),
               "<home> & \"co\": methods compared");
  EXPECT_THAT(html, Not(HasSubstr("http")));
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr("url(")));
  EXPECT_THAT(html, HasSubstr("a&lt;b&gt;.jpg"));
  EXPECT_THAT(html, HasSubstr("x&amp;y.jpg"));
  // Every picture lies in the page: RFC 4648 with padding.
  EXPECT_THAT(html, HasSubstr("src=\"data:image/jpeg;base64,b3V0c2lkZQ==\""));
  EXPECT_THAT(html, HasSubstr("src=\"data:image/jpeg;base64,cGhvdG8=\""));
  EXPECT_THAT(html, HasSubstr("src=\"data:image/jpeg;base64,aW5zaWRl\""));
}

TEST(ComparisonPage, ShowsTablePlansAndReasons) {
  const pugi::xml_document document = Parsed(FormatComparisonPage(MakePage()));
  const auto rows = document.select_nodes("//table[1]/tbody/tr");
  ASSERT_GE(rows.size(), 2u);
  EXPECT_STREQ(document.select_node("(//table)[1]//tr[1]/td[1]").node().text().get(), "3.10");
  EXPECT_STREQ(document.select_node("(//table)[1]//tr[1]/td[1]").node().attribute("class").value(),
               "best");
  EXPECT_STREQ(document.select_node("//td[@class='gone']").node().text().get(),
               "not done after <1> s");
  // One plan, of the method that found one: a room with a hole, the truth, a camera.
  EXPECT_EQ(document.select_nodes("//svg").size(), 1u);
  EXPECT_STREQ(document.select_node("//path[@class='room']").node().attribute("d").value(),
               "M0.000 0.000L4.000 0.000L4.000 -3.000L0.000 -3.000ZM1.000 -1.000L1.000 "
               "-2.000L2.000 -2.000L2.000 -1.000Z");
  EXPECT_EQ(document.select_nodes("//path[@class='truth']").size(), 1u);
  EXPECT_EQ(document.select_nodes("//circle").size(), 1u);
  EXPECT_EQ(document.select_nodes("//details[@open]").size(), 1u);
}

TEST(ComparisonPage, LeavesOutWhatNoMethodHasAndSaysSo) {
  ComparisonPage page = MakePage();
  EXPECT_THAT(FormatComparisonPage(page), HasSubstr("this truth knows neither"));
  EXPECT_THAT(FormatComparisonPage(page), Not(HasSubstr("depth error")));
  page.methods[0].figures["depth_median_m"] = 0.02;
  EXPECT_THAT(FormatComparisonPage(page), Not(HasSubstr("this truth knows neither")));
  EXPECT_THAT(FormatComparisonPage(page), HasSubstr("depth error"));
}

TEST(ComparisonPage, SaysWhatIsMissing) {
  ComparisonPage page = MakePage();
  page.truth.reset();
  page.labels = {};
  page.labels.reason = "pano.jpg: has changed";
  for (ComparedMethod& method : page.methods) method.figures.erase("area_error_gross");
  const std::string html = FormatComparisonPage(page);
  Parsed(html);
  EXPECT_THAT(html, HasSubstr("No truth was given"));
  EXPECT_THAT(html, HasSubstr("There are none: pano.jpg: has changed."));
  EXPECT_THAT(html, Not(HasSubstr("area error")));
}

TEST(ComparisonPage, StandsWithoutAnyResult) {
  ComparisonPage page = MakePage();
  page.methods.erase(page.methods.begin());
  page.truth.reset();
  page.cameras.clear();
  page.labels.sheets.assign(100, page.labels.sheets[0]);
  const std::string html = FormatComparisonPage(page);
  EXPECT_EQ(Parsed(html).select_nodes("//svg").size(), 0u);
  EXPECT_THAT(html, HasSubstr("other 36 panoramas lie beside this page"));
}

TEST(ComparedLabels, AreGivenAsJsonAndAsALine) {
  const ComparedLabels labels = MakePage().labels;
  EXPECT_EQ(LabelsToJson(labels).at("superpixels"), 0.96);
  EXPECT_TRUE(LabelsToJson(labels).at("points").is_null());
  EXPECT_THAT(FormatLabels(labels), HasSubstr("final 96.0 %"));
}

}  // namespace
}  // namespace enfilade
