// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/base/options.h"

#include <gmock/gmock.h>

#include <array>
#include <nlohmann/json.hpp>

#include "enfilade/base/errors.h"

namespace enfilade {

enum class Shape { kRound, kSquare };
std::span<const std::string_view> EnumNames(Shape) {
  static constexpr std::array<std::string_view, 2> kNames = {"round", "square"};
  return kNames;
}

namespace {

using Json = nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

struct InnerOptions {
  double cell_m = 0.025;
  Shape shape = Shape::kSquare;
  void Visit(OptionVisitor& v) {
    v("cell_m", cell_m, "Edge of a cell, in metres.", {0.001, 1.0});
    v("shape", shape, "Form of the kernel.");
  }
};

struct MiddleOptions {
  InnerOptions grid;
  int rounds = 3;
  void Visit(OptionVisitor& v) {
    v("grid", grid, "The grid.");
    v("rounds", rounds, "Number of rounds.", {0, 10});
  }
};

struct OuterOptions {
  MiddleOptions evidence;
  InnerOptions fine;
  bool is_on = true;
  double cost_m = 2;
  std::string title = "a|b";
  void Visit(OptionVisitor& v) {
    v("evidence", evidence, "Evidence.");
    v("fine", fine, "A finer grid.");
    v("is_on", is_on, "Switch.");
    v("cost_m", cost_m, "Cost, a | b.", {0.0});
    v("title", title, "Title.");
  }
};

TEST(ListOptions, PathsInOrderOfTheVisit) {
  OuterOptions options;
  std::vector<std::string> paths;
  for (const OptionInfo& info : ListOptions(VisitorOf(options))) paths.push_back(info.path);
  EXPECT_THAT(paths, ElementsAre("evidence.grid.cell_m", "evidence.grid.shape", "evidence.rounds",
                                 "fine.cell_m", "fine.shape", "is_on", "cost_m", "title"));
}

TEST(ListOptions, TellsTypeValueRangeAndChoices) {
  OuterOptions options;
  const auto infos = ListOptions(VisitorOf(options));
  EXPECT_EQ(infos[0].type, "real");
  EXPECT_EQ(infos[0].value, "0.025");
  EXPECT_EQ(infos[0].range.max, 1.0);
  EXPECT_EQ(infos[0].help, "Edge of a cell, in metres.");
  EXPECT_EQ(infos[1].type, "choice");
  EXPECT_EQ(infos[1].value, "square");
  EXPECT_THAT(infos[1].choices, ElementsAre("round", "square"));
  EXPECT_EQ(infos[2].type, "int");
  EXPECT_EQ(infos[5].type, "bool");
  EXPECT_EQ(infos[5].value, "true");
  EXPECT_EQ(infos[7].type, "text");
}

TEST(SetOption, SetsEveryType) {
  OuterOptions options;
  const VisitFunction visit = VisitorOf(options);
  SetOption(visit, "evidence.grid.cell_m", "0.5", "--set");
  SetOption(visit, "fine.shape", "round", "--set");
  SetOption(visit, "evidence.rounds", "7", "--set");
  SetOption(visit, "is_on", "false", "--set");
  SetOption(visit, "cost_m", "1e3", "--set");
  SetOption(visit, "title", "π, x", "--set");
  EXPECT_EQ(options.evidence.grid.cell_m, 0.5);
  EXPECT_EQ(options.evidence.grid.shape, Shape::kSquare);
  EXPECT_EQ(options.fine.shape, Shape::kRound);
  EXPECT_EQ(options.evidence.rounds, 7);
  EXPECT_FALSE(options.is_on);
  EXPECT_EQ(options.cost_m, 1000);
  EXPECT_EQ(options.title, "π, x");
}

TEST(SetOption, ValuesReadBackFromTheList) {
  OuterOptions options;
  options.cost_m = 0.1 + 0.2;  // needs all 17 digits
  OuterOptions copy;
  for (const OptionInfo& info : ListOptions(VisitorOf(options))) {
    SetOption(VisitorOf(copy), info.path, info.value, "list");
  }
  EXPECT_EQ(copy.cost_m, options.cost_m);
}

TEST(SetOption, RefusesBadValuesAndKeepsTheOld) {
  OuterOptions options;
  const VisitFunction visit = VisitorOf(options);
  const std::pair<const char*, const char*> bad[] = {{"evidence.grid.cell_m", "2"},
                                                     {"evidence.grid.cell_m", "nan"},
                                                     {"evidence.grid.cell_m", "inf"},
                                                     {"evidence.grid.cell_m", ""},
                                                     {"evidence.grid.cell_m", "0.1 "},
                                                     {"evidence.grid.cell_m", "0,1"},
                                                     {"evidence.rounds", "1.5"},
                                                     {"evidence.rounds", "99999999999"},
                                                     {"evidence.rounds", "11"},
                                                     {"evidence.rounds", "x"},
                                                     {"is_on", "yes"},
                                                     {"is_on", "1"},
                                                     {"fine.shape", "oval"},
                                                     {"title", "\xff"},
                                                     {"cost_m", "-1"},
                                                     {"cost_m", "1e999"}};
  for (const auto& [path, value] : bad) {
    EXPECT_THROW(SetOption(visit, path, value, "--set"), InvalidInputError) << path << "=" << value;
  }
  EXPECT_EQ(OptionsToJson(visit), OptionsToJson([&] {
              static OuterOptions defaults;
              return VisitorOf(defaults);
            }()));
}

TEST(SetOption, MessagesNameOptionValueAndCure) {
  OuterOptions options;
  const VisitFunction visit = VisitorOf(options);
  EXPECT_THAT(
      [&] { SetOption(visit, "evidence.grid.cell_m", "2", "--set"); },
      ThrowsMessage<InvalidInputError>(AllOf(HasSubstr("--set: option evidence.grid.cell_m"),
                                             HasSubstr("'2'"), HasSubstr("0.001 … 1"))));
  EXPECT_THAT([&] { SetOption(visit, "fine.shape", "oval", "--set"); },
              ThrowsMessage<InvalidInputError>(HasSubstr("one of round, square")));
  EXPECT_THAT([&] { SetOption(visit, "title", "\xff", "--set"); },
              ThrowsMessage<InvalidInputError>(HasSubstr("text in UTF-8")));
  EXPECT_THAT([&] { SetOption(visit, "evidence.cell_m", "1", "--set"); },
              ThrowsMessage<InvalidInputError>(HasSubstr("no option 'evidence.cell_m'")));
  EXPECT_THAT([&] { SetOption(visit, "evidence.round", "1", "--set"); },
              ThrowsMessage<InvalidInputError>(HasSubstr("did you mean 'evidence.rounds'?")));
  EXPECT_THAT([&] { SetOption(visit, "zzzzzz", "1", "--set"); },
              ThrowsMessage<InvalidInputError>(
                  AllOf(HasSubstr("enfilade config"), Not(HasSubstr("did you mean")))));
}

TEST(OptionsJson, RoundTrip) {
  OuterOptions options;
  options.evidence.grid.cell_m = 0.1;
  options.evidence.grid.shape = Shape::kRound;
  options.title = "x";
  const Json json = OptionsToJson(VisitorOf(options));
  EXPECT_EQ(json["evidence"]["grid"]["cell_m"], 0.1);
  EXPECT_EQ(json["evidence"]["grid"]["shape"], "round");
  EXPECT_EQ(json["is_on"], true);
  OuterOptions copy;
  OptionsFromJson(VisitorOf(copy), json, "config.json");
  EXPECT_EQ(OptionsToJson(VisitorOf(copy)), json);
}

TEST(OptionsJson, NamesOnlyWhatChanges) {
  OuterOptions options;
  OptionsFromJson(VisitorOf(options), Json::parse(R"({"evidence": {"rounds": 1}, "cost_m": 3})"),
                  "config.json");
  EXPECT_EQ(options.evidence.rounds, 1);
  EXPECT_EQ(options.cost_m, 3);
  EXPECT_EQ(options.evidence.grid.cell_m, 0.025);
  OptionsFromJson(VisitorOf(options), Json::object(), "config.json");
  EXPECT_EQ(options.cost_m, 3);
}

TEST(OptionsJson, RefusesWrongTypesAndUnknownKeys) {
  const char* bad[] = {R"([])",
                       R"(null)",
                       R"({"is_on": "true"})",
                       R"({"is_on": 1})",
                       R"({"evidence": {"rounds": 1.0}})",
                       R"({"evidence": {"rounds": "1"}})",
                       R"({"evidence": {"rounds": 11}})",
                       R"({"evidence": 3})",
                       R"({"evidence": {"gird": {}}})",
                       R"({"unknown": {}})",
                       R"({"cost_m": null})",
                       R"({"cost_m": [1]})",
                       R"({"cost_m": {"x": 1}})",
                       R"({"cost_m": -1})",
                       R"({"fine": {"shape": 0}})",
                       R"({"title": 5})"};
  for (const char* text : bad) {
    OuterOptions options;
    EXPECT_THROW(OptionsFromJson(VisitorOf(options), Json::parse(text), "c"), InvalidInputError)
        << text;
  }
}

TEST(OptionsJson, DeepNestingIsAnErrorAndNoCrash) {
  std::string text;
  for (int i = 0; i < 100'000; ++i) text += R"({"evidence":)";
  text += "1" + std::string(100'000, '}');
  OuterOptions options;
  EXPECT_THROW(OptionsFromJson(VisitorOf(options), Json::parse(text), "c"), InvalidInputError);
}

TEST(ValidateOptions, SeesRangesAndNan) {
  OuterOptions options;
  EXPECT_NO_THROW(ValidateOptions(VisitorOf(options), "options"));
  options.evidence.grid.cell_m = 0;
  EXPECT_THAT([&] { ValidateOptions(VisitorOf(options), "options"); },
              ThrowsMessage<InvalidInputError>(HasSubstr("evidence.grid.cell_m")));
  options = {};
  options.cost_m = std::nan("");
  EXPECT_THROW(ValidateOptions(VisitorOf(options), "options"), InvalidInputError);
  options.cost_m = std::numeric_limits<double>::infinity();
  EXPECT_THROW(ValidateOptions(VisitorOf(options), "options"), InvalidInputError);
  options.cost_m = std::numeric_limits<double>::denorm_min();
  EXPECT_NO_THROW(ValidateOptions(VisitorOf(options), "options"));
  options.evidence.rounds = -1;
  EXPECT_THROW(ValidateOptions(VisitorOf(options), "options"), InvalidInputError);
}

TEST(OptionsReference, IsATable) {
  OuterOptions options;
  const std::string page = OptionsReference(VisitorOf(options));
  EXPECT_THAT(page, HasSubstr("| `evidence.grid.cell_m` | real | 0.025 | 0.001 … 1 | Edge of"));
  EXPECT_THAT(page, HasSubstr("| `fine.shape` | choice | square | round, square | Form of"));
  EXPECT_THAT(page, HasSubstr("| `cost_m` | real | 2 | ≥ 0 | Cost, a \\| b. |"));
  EXPECT_THAT(page, HasSubstr("a\\|b"));
}

TEST(NearestWord, WithinAThirdOfTheLength) {
  const std::vector<std::string> words = {"threads", "seed", "camera-height"};
  EXPECT_EQ(NearestWord("thread", words), "threads");
  EXPECT_EQ(NearestWord("sede", words), "seed");
  EXPECT_EQ(NearestWord("camera_heigth", words), "camera-height");
  EXPECT_EQ(NearestWord("memory", words), "");
  EXPECT_EQ(NearestWord("x", {}), "");
}

TEST(NearestWord, FirstOfEquallyNear) {
  const std::vector<std::string> words = {"aab", "aac"};
  EXPECT_EQ(NearestWord("aaa", words), "aab");
}

}  // namespace
}  // namespace enfilade
