// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/base/json.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

using Json = nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(ReadJsonFile, NamesTheLineOfASyntaxError) {
  const TempFolder folder;
  WriteFileAtomic(folder / "cut.json", "{\n  \"a\": 1,\n  \"b\": [1, 2");
  EXPECT_THAT([&] { (void)ReadJsonFile(folder / "cut.json"); },
              ThrowsMessage<InvalidInputError>(AllOf(HasSubstr("cut.json"), HasSubstr("line 3"))));
}

TEST(ReadJsonFile, RefusesBrokenFiles) {
  const TempFolder folder;
  const std::string broken[] = {"",
                                " ",
                                "{",
                                "{\"a\": nan}",
                                "{\"a\": Infinity}",
                                "{\"a\": 1e999}",
                                "{\"a\": \"\xff\"}",
                                "{} {}",
                                std::string("\0\0\0\0", 4),
                                std::string(100'000, '[')};
  for (const std::string& text : broken) {
    WriteFileAtomic(folder / "f.json", text);
    EXPECT_THROW((void)ReadJsonFile(folder / "f.json"), InvalidInputError) << text.substr(0, 20);
  }
  WriteFileAtomic(folder / "f.json", std::string(100, ' ') + "{}");
  EXPECT_THROW((void)ReadJsonFile(folder / "f.json", 50), InvalidInputError);
  EXPECT_THROW((void)ReadJsonFile(folder / "missing.json"), IoError);
}

TEST(WriteJsonFile, SortsKeysAndKeepsNumbers) {
  const TempFolder folder;
  const Json json = {{"b", 0.1}, {"a", {1, 2.5, 1.0 / 3.0}}, {"text", "bad \xff byte"}};
  WriteJsonFile(folder / "f.json", json);
  EXPECT_EQ(ReadFile(folder / "f.json"),
            "{\n  \"a\": [1, 2.5, 0.3333333333333333],\n  \"b\": 0.1,\n"
            "  \"text\": \"bad \xEF\xBF\xBD byte\"\n}\n");
  EXPECT_EQ(ReadJsonFile(folder / "f.json")["a"][2].get<double>(), 1.0 / 3.0);
}

TEST(WriteJsonFile, PutsArraysOfPlainValuesOnOneLine) {
  const TempFolder folder;
  const Json json = Json::parse(R"({"ring": [[0, 1], [2, 3]], "none": [], "list": [{"k": {}}]})");
  WriteJsonFile(folder / "f.json", json);
  EXPECT_EQ(ReadFile(folder / "f.json"),
            "{\n  \"list\": [\n    {\n      \"k\": {}\n    }\n  ],\n  \"none\": [],\n"
            "  \"ring\": [\n    [0, 1],\n    [2, 3]\n  ]\n}\n");
  EXPECT_EQ(ReadJsonFile(folder / "f.json"), json);
}

TEST(TypedAccess, GivesValues) {
  const Json json = Json::parse(R"({"n": 1.5, "i": -3, "s": "x", "a": [1], "o": {"k": 2}})");
  EXPECT_EQ(JsonNumber(json, "n", "f"), 1.5);
  EXPECT_EQ(JsonNumber(json, "i", "f"), -3);
  EXPECT_EQ(JsonInteger(json, "i", "f"), -3);
  EXPECT_EQ(JsonString(json, "s", "f"), "x");
  EXPECT_EQ(JsonArray(json, "a", "f").size(), 1);
  EXPECT_EQ(JsonInteger(JsonObject(json, "o", "f"), "k", "f"), 2);
}

TEST(TypedAccess, NamesFileAndKey) {
  const Json json = Json::parse(R"({"n": "1.5", "i": 1.5, "null": null})");
  EXPECT_THAT([&] { (void)JsonNumber(json, "n", "poses.json"); },
              ThrowsMessage<InvalidInputError>(
                  AllOf(HasSubstr("poses.json"), HasSubstr("'n' is string"), HasSubstr("number"))));
  EXPECT_THAT([&] { (void)JsonNumber(json, "x", "poses.json"); },
              ThrowsMessage<InvalidInputError>(HasSubstr("'x' is missing")));
  EXPECT_THROW((void)JsonInteger(json, "i", "f"), InvalidInputError);
  EXPECT_THROW((void)JsonNumber(json, "null", "f"), InvalidInputError);
  EXPECT_THROW((void)JsonString(json, "i", "f"), InvalidInputError);
  EXPECT_THROW((void)JsonArray(json, "n", "f"), InvalidInputError);
  EXPECT_THROW((void)JsonObject(json, "n", "f"), InvalidInputError);
  EXPECT_THROW((void)JsonNumber(Json::array(), "n", "f"), InvalidInputError);
  EXPECT_THROW((void)JsonNumber(Json{{"x", std::nan("")}}, "x", "f"), InvalidInputError);
}

TEST(TypedAccess, WholeNumbersThatDoNotFit) {
  const Json json = Json::parse(R"({"big": 18446744073709551615, "max": 9223372036854775807})");
  EXPECT_EQ(JsonInteger(json, "max", "f"), std::numeric_limits<int64_t>::max());
  EXPECT_THROW((void)JsonInteger(json, "big", "f"), InvalidInputError);
}

}  // namespace
}  // namespace enfilade
