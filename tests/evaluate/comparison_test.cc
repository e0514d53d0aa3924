// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/comparison.h"

#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "tests/support/plan_fixtures.h"

namespace enfilade {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

ComparedMethod Method(const std::string& name, std::optional<double> area_error,
                      MethodOutcome outcome = MethodOutcome::kFound) {
  ComparedMethod method;
  method.name = method.title = name;
  method.outcome = outcome;
  method.figures["area_error_gross"] = area_error;
  return method;
}

const ComparedFigure& Column(std::string_view key) {
  for (const ComparedFigure& column : ComparedFigures()) {
    if (column.key == key) return column;
  }
  throw std::logic_error("no such column");
}

std::string FirstVerdict(const std::vector<ComparedMethod>& methods) {
  return Verdicts(methods).at(0).text;
}

TEST(AddSizes, CountsRoomsCornersAndFaces) {
  MetricReport figures;
  AddSizes(
      MakePlan({MakeRoom(0, "0,0 4,0 4,3 0,3", {"1,1 1,2 2,2 2,1"}), MakeRoom(1, "5,0 6,0 6,1")}),
      7, figures);
  EXPECT_EQ(figures.at("rooms"), 2);
  EXPECT_EQ(figures.at("corners"), 11);
  EXPECT_EQ(figures.at("faces"), 7);
}

TEST(ComparedText, HasTheUnitAndDecimalsOfItsColumn) {
  EXPECT_EQ(ComparedText(Column("area_error_gross"), Method("a", 0.0331)), "3.31");
  EXPECT_EQ(ComparedText(Column("area_error_gross"), Method("a", std::nullopt)), "–");
  EXPECT_EQ(ComparedText(Column("depth_median_m"), Method("a", 0.1)), "–");
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(ComparedText(Column("area_error_gross"), Method("a", infinity)), "–");
}

TEST(BestOf, MarksTheBestAndThoseThatLookTheSame) {
  const std::vector<ComparedMethod> methods = {Method("a", 0.05), Method("b", 0.040001),
                                               Method("c", 0.04), Method("d", std::nullopt),
                                               Method("e", 0.01, MethodOutcome::kOutOfTime)};
  EXPECT_THAT(BestOf(Column("area_error_gross"), methods),
              ElementsAre(false, true, true, false, false));
  EXPECT_THAT(BestOf(Column("rooms"), methods), ElementsAre(false, false, false, false, false));
  std::vector<ComparedMethod> walls = {Method("a", 0), Method("b", 0)};
  walls[0].figures["wall_within_10cm"] = 0.5;
  walls[1].figures["wall_within_10cm"] = 0.7;
  EXPECT_THAT(BestOf(Column("wall_within_10cm"), walls), ElementsAre(false, true));
}

TEST(Verdicts, SayWhereTheFullSolverIsNotBetter) {
  EXPECT_EQ(FirstVerdict({Method("full", 0.04), Method("a", 0.05), Method("b", 0.06)}),
            "The full solver's area error, 4.00 %, is below that of every rival; the next is a "
            "with 5.00 %.");
  EXPECT_EQ(FirstVerdict({Method("full", 0.04), Method("a", 0.04), Method("b", 0.06),
                          Method("c", 0.0123), Method("d", 0.01)}),
            "The full solver's area error, 4.00 %, is not below that of a (4.00 %), c (1.23 %) and "
            "d (1.00 %).");
}

TEST(Verdicts, TellApartWhatIsNearlyTheSame) {
  EXPECT_THAT(FirstVerdict({Method("full", 0.033191), Method("a", 0.033207)}),
              HasSubstr("3.319 %, is below that of every rival; the next is a with 3.321 %"));
  EXPECT_THAT(FirstVerdict({Method("full", 0.033207), Method("a", 0.033191), Method("b", 0.01)}),
              HasSubstr("3.321 %, is not below that of a (3.319 %) and b (1.000 %)."));
}

TEST(Verdicts, NameWhoHasNoResultAndWhy) {
  std::vector<ComparedMethod> methods = {Method("full", 0.04),
                                         Method("a", std::nullopt, MethodOutcome::kOutOfTime),
                                         Method("b", std::nullopt, MethodOutcome::kFailed),
                                         Method("c", std::nullopt, MethodOutcome::kNoResult)};
  methods[1].reason = "not done after 1 s";
  methods[2].reason = "it was killed";
  methods[3].reason = "nothing is inside";
  const std::vector<Verdict> verdicts = Verdicts(methods);
  ASSERT_EQ(verdicts.size(), 3u);
  EXPECT_EQ(verdicts[0].text, "A gave up: not done after 1 s.");
  EXPECT_EQ(verdicts[1].text, "B failed: it was killed.");
  EXPECT_EQ(verdicts[2].text, "C found nothing: nothing is inside.");
  for (const Verdict& verdict : verdicts) EXPECT_FALSE(verdict.is_good);
}

TEST(FormatComparison, AlignsColumnsAndMarksTheBest) {
  std::vector<ComparedMethod> methods = {Method("full", 0.04), Method("2D cut, λ = 100", 0.05)};
  const std::string text = FormatComparison(methods);
  EXPECT_THAT(text, HasSubstr("\nfull              4.00*"));
  EXPECT_THAT(text, HasSubstr("\n2D cut, λ = 100   5.00"));
  EXPECT_THAT(text, HasSubstr("is below that of every rival"));
}

TEST(ComparisonToJson, HasTheFiguresOfTheTable) {
  ComparedMethod late = Method("a", std::nullopt, MethodOutcome::kOutOfMemory);
  late.reason = "too large";
  late.figures["seconds"] = 2.5;
  const nlohmann::json json = ComparisonToJson(std::vector{Method("full", 0.04), late});
  EXPECT_EQ(json.at("methods").at(0).at("figures").at("area_error_gross"), 0.04);
  EXPECT_EQ(json.at("methods").at(0).at("outcome"), "found");
  EXPECT_EQ(json.at("methods").at(1).at("outcome"), "out_of_memory");
  EXPECT_EQ(json.at("methods").at(1).at("reason"), "too large");
  EXPECT_EQ(json.at("methods").at(1).at("figures").at("seconds"), 2.5);
  EXPECT_TRUE(json.at("methods").at(1).at("figures").at("area_error_gross").is_null());
  EXPECT_EQ(json.at("verdicts").size(), 1u);
}

}  // namespace
}  // namespace enfilade
