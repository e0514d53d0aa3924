// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/base/json.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"

namespace enfilade {
namespace {

using Json = nlohmann::json;

const Json& Member(const Json& object, const char* key, const std::string& where,
                   bool (Json::*is_right)() const noexcept, const char* type) {
  const auto it = object.is_object() ? object.find(key) : object.end();
  if (it == object.end()) {
    throw InvalidInputError(where, std::string("key '") + key + "' is missing",
                            "check that the file is complete");
  }
  if (!((*it).*is_right)()) {
    throw InvalidInputError(where, std::string("key '") + key + "' is " + it->type_name(),
                            std::string("make it ") + type);
  }
  return *it;
}

std::string DumpPlain(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// Objects and arrays that hold objects or arrays have a line for each member; arrays of plain
// values, such as points and matrices, stand on one line.
void DumpIndented(const Json& value, const std::string& indent, std::string& text) {
  const bool is_array = value.is_array();
  const auto is_nested = [](const Json& member) { return member.is_structured(); };
  if (!value.is_structured() || value.empty()) {
    text += DumpPlain(value);
    return;
  }
  const bool is_one_line = is_array && std::none_of(value.begin(), value.end(), is_nested);
  const std::string deeper = indent + "  ";
  text += is_array ? "[" : "{";
  for (auto it = value.begin(); it != value.end(); ++it) {
    if (it != value.begin()) text += is_one_line ? ", " : ",";
    if (!is_one_line) text.append("\n").append(deeper);
    if (!is_array) text.append(DumpPlain(Json(it.key()))).append(": ");
    DumpIndented(*it, deeper, text);
  }
  if (!is_one_line) text.append("\n").append(indent);
  text += is_array ? "]" : "}";
}

}  // namespace

Json ReadJsonFile(const std::filesystem::path& path, uint64_t max_bytes) {
  const std::string text = ReadFile(path, max_bytes);
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const size_t end = std::min(error.byte, text.size());
    const auto line =
        1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
    throw InvalidInputError(path.native(), "is no valid JSON (line " + std::to_string(line) + ")",
                            text.empty() ? "the file is empty" : "check that the file is complete");
  } catch (const Json::out_of_range&) {
    throw InvalidInputError(path.native(), "holds a number that is too large",
                            "write numbers below 1e308");
  }
}

void WriteJsonFile(const std::filesystem::path& path, const Json& json) {
  std::string text;
  DumpIndented(json, "", text);
  WriteFileAtomic(path, text + "\n");
}

double JsonNumber(const Json& object, const char* key, const std::string& where) {
  const double value = Member(object, key, where, &Json::is_number, "a number").get<double>();
  if (!std::isfinite(value)) {
    throw InvalidInputError(where, std::string("key '") + key + "' is not finite",
                            "make it a number");
  }
  return value;
}

int64_t JsonInteger(const Json& object, const char* key, const std::string& where) {
  const Json& member = Member(object, key, where, &Json::is_number_integer, "a whole number");
  if (member.is_number_unsigned() &&
      member.get<uint64_t>() > uint64_t{std::numeric_limits<int64_t>::max()}) {
    throw InvalidInputError(where, std::string("key '") + key + "' is too large",
                            "write whole numbers below 2^63");
  }
  return member.get<int64_t>();
}

std::string JsonString(const Json& object, const char* key, const std::string& where) {
  return Member(object, key, where, &Json::is_string, "a string").get<std::string>();
}

const Json& JsonArray(const Json& object, const char* key, const std::string& where) {
  return Member(object, key, where, &Json::is_array, "an array");
}

const Json& JsonObject(const Json& object, const char* key, const std::string& where) {
  return Member(object, key, where, &Json::is_object, "an object");
}

}  // namespace enfilade
