// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/base/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "enfilade/base/check.h"
#include "enfilade/base/errors.h"

namespace enfilade {
namespace {

using Json = nlohmann::json;

// Keeps track of the dotted path while a visit descends into groups.
class PathVisitor : public OptionVisitor {
 protected:
  [[nodiscard]] std::string Path(std::string_view name) const {
    return prefix_ + std::string(name);
  }
  void BeginGroup(std::string_view name, std::string_view) override {
    prefix_ += std::string(name) + ".";
  }
  void EndGroup() override {
    prefix_.pop_back();
    prefix_.erase(prefix_.find_last_of('.') + 1);
  }

 private:
  std::string prefix_;
};

std::string FormatReal(double value) { return fmt::format("{}", value); }

class ListVisitor final : public PathVisitor {
 public:
  std::vector<OptionInfo> infos;

 protected:
  void VisitBool(std::string_view name, bool& value, std::string_view help) override {
    Add(name, "bool", value ? "true" : "false", help, {}, {});
  }
  void VisitInt(std::string_view name, int& value, std::string_view help, Range range) override {
    Add(name, "int", std::to_string(value), help, range, {});
  }
  void VisitReal(std::string_view name, double& value, std::string_view help,
                 Range range) override {
    Add(name, "real", FormatReal(value), help, range, {});
  }
  void VisitText(std::string_view name, std::string& value, std::string_view help) override {
    Add(name, "text", value, help, {}, {});
  }
  void VisitChoice(std::string_view name, int& value, std::span<const std::string_view> names,
                   std::string_view help) override {
    ENFILADE_CHECK(value >= 0 && value < static_cast<int>(names.size()));
    Add(name, "choice", std::string(names[static_cast<size_t>(value)]), help, {},
        {names.begin(), names.end()});
  }

 private:
  void Add(std::string_view name, std::string type, std::string value, std::string_view help,
           Range range, std::vector<std::string> choices) {
    infos.push_back({Path(name), std::move(type), std::move(value), std::string(help), range,
                     std::move(choices)});
  }
};

[[noreturn]] void ThrowBadValue(const std::string& where, const std::string& path,
                                const std::string& value, const std::string& expected) {
  throw InvalidInputError(where, "option " + path + " has the value '" + value + "'",
                          "give " + expected);
}

std::string RangeText(const OptionInfo& info) {
  const bool has_min = std::isfinite(info.range.min);
  const bool has_max = std::isfinite(info.range.max);
  if (has_min && has_max) return fmt::format("{} … {}", info.range.min, info.range.max);
  if (has_min) return fmt::format("≥ {}", info.range.min);
  if (has_max) return fmt::format("≤ {}", info.range.max);
  return "";
}

std::string Expectation(const OptionInfo& info) {
  if (info.type == "bool") return "true or false";
  if (info.type == "text") return "a text in UTF-8";
  if (info.type == "choice") return fmt::format("one of {}", fmt::join(info.choices, ", "));
  const std::string noun = info.type == "int" ? "a whole number" : "a number";
  const std::string range = RangeText(info);
  return range.empty() ? noun : noun + " in " + range;
}

bool InRange(double value, const Range& range) {
  return std::isfinite(value) && value >= range.min && value <= range.max;
}

// Writes one field from text and checks it.
class SetVisitor final : public PathVisitor {
 public:
  SetVisitor(std::string_view path, std::string_view text) : path_(path), text_(text) {}
  bool found = false;
  bool is_valid = false;

 protected:
  void VisitBool(std::string_view name, bool& value, std::string_view) override {
    if (!Matches(name)) return;
    is_valid = text_ == "true" || text_ == "false";
    if (is_valid) value = text_ == "true";
  }
  void VisitInt(std::string_view name, int& value, std::string_view, Range range) override {
    if (Matches(name)) Parse(value, range);
  }
  void VisitReal(std::string_view name, double& value, std::string_view, Range range) override {
    if (Matches(name)) Parse(value, range);
  }
  void VisitText(std::string_view name, std::string& value, std::string_view) override {
    if (!Matches(name)) return;
    is_valid = IsValidUtf8(text_);
    if (is_valid) value = std::string(text_);
  }
  void VisitChoice(std::string_view name, int& value, std::span<const std::string_view> names,
                   std::string_view) override {
    if (!Matches(name)) return;
    const auto it = std::find(names.begin(), names.end(), text_);
    is_valid = it != names.end();
    if (is_valid) value = static_cast<int>(it - names.begin());
  }

 private:
  bool Matches(std::string_view name) {
    const bool matches = Path(name) == path_;
    found |= matches;
    return matches;
  }
  template <typename T>
  void Parse(T& value, const Range& range) {
    T parsed{};
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), parsed);
    is_valid = error == std::errc() && end == text_.data() + text_.size() &&
               InRange(static_cast<double>(parsed), range);
    if (is_valid) value = parsed;
  }

  std::string_view path_;
  std::string_view text_;
};

// Option values as text: JSON numbers and booleans keep their spelling, strings lose the quotes.
std::string JsonToText(const Json& json) {
  return json.is_string() ? json.get<std::string>() : json.dump();
}

bool HasRightType(const OptionInfo& info, const Json& json) {
  if (info.type == "bool") return json.is_boolean();
  if (info.type == "int") return json.is_number_integer();
  if (info.type == "real") return json.is_number();
  return json.is_string();
}

size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t substitution = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitution});
    }
  }
  return row[b.size()];
}

[[noreturn]] void ThrowUnknown(const std::vector<OptionInfo>& infos, std::string_view path,
                               const std::string& where) {
  std::vector<std::string> paths;
  paths.reserve(infos.size());
  for (const OptionInfo& info : infos) paths.push_back(info.path);
  const std::string nearest = NearestWord(path, paths);
  throw InvalidInputError(
      where, "there is no option '" + std::string(path) + "'",
      nearest.empty() ? "'enfilade config' lists all options" : "did you mean '" + nearest + "'?");
}

const OptionInfo& FindOption(const std::vector<OptionInfo>& infos, std::string_view path,
                             const std::string& where) {
  const auto it = std::find_if(infos.begin(), infos.end(),
                               [&](const OptionInfo& info) { return info.path == path; });
  if (it == infos.end()) ThrowUnknown(infos, path, where);
  return *it;
}

// Options whose path starts with `prefix`; none for a group that does not exist.
bool IsGroup(const std::vector<OptionInfo>& infos, const std::string& prefix) {
  return std::any_of(infos.begin(), infos.end(),
                     [&](const OptionInfo& info) { return info.path.starts_with(prefix); });
}

// Goes down only into groups that exist, so that a deeply nested file cannot exhaust the stack.
void SetFromJson(const VisitFunction& options, const std::vector<OptionInfo>& infos,
                 const Json& json, const std::string& prefix, const std::string& where) {
  for (const auto& [key, value] : json.items()) {
    const std::string path = prefix + key;
    if (value.is_object() && IsGroup(infos, path + ".")) {
      SetFromJson(options, infos, value, path + ".", where);
      continue;
    }
    const OptionInfo& info = FindOption(infos, path, where);
    if (!HasRightType(info, value)) {
      ThrowBadValue(where, path, value.is_structured() ? value.type_name() : JsonToText(value),
                    Expectation(info));
    }
    SetOption(options, path, JsonToText(value), where);
  }
}

double ParseReal(const std::string& text) {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::string EscapeTableCell(std::string text) {
  for (size_t i = text.find('|'); i != std::string::npos; i = text.find('|', i + 2)) {
    text.insert(i, "\\");
  }
  return text;
}

}  // namespace

std::vector<OptionInfo> ListOptions(const VisitFunction& options) {
  ListVisitor visitor;
  options(visitor);
  return std::move(visitor.infos);
}

void SetOption(const VisitFunction& options, std::string_view path, std::string_view value,
               const std::string& where) {
  SetVisitor visitor(path, value);
  options(visitor);
  if (visitor.found && visitor.is_valid) return;
  const std::vector<OptionInfo> infos = ListOptions(options);
  const OptionInfo& info = FindOption(infos, path, where);
  ThrowBadValue(where, info.path, std::string(value), Expectation(info));
}

Json OptionsToJson(const VisitFunction& options) {
  Json json = Json::object();
  for (const OptionInfo& info : ListOptions(options)) {
    std::string pointer = "/" + info.path;
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    const bool is_word = info.type == "text" || info.type == "choice";
    const Json value = is_word ? Json(info.value) : Json::parse(info.value, nullptr, false);
    ENFILADE_CHECK_MSG(!value.is_discarded(), info.path + " = " + info.value);
    json[Json::json_pointer(pointer)] = value;
  }
  return json;
}

void OptionsFromJson(const VisitFunction& options, const Json& json, const std::string& where) {
  if (!json.is_object()) {
    throw InvalidInputError(where, "options are no JSON object", "see 'enfilade config'");
  }
  SetFromJson(options, ListOptions(options), json, "", where);
}

void ValidateOptions(const VisitFunction& options, const std::string& where) {
  for (const OptionInfo& info : ListOptions(options)) {
    if (info.type != "int" && info.type != "real") continue;
    if (!InRange(ParseReal(info.value), info.range)) {
      ThrowBadValue(where, info.path, info.value, Expectation(info));
    }
  }
}

std::string OptionsReference(const VisitFunction& options) {
  std::string page = "| option | type | default | range | meaning |\n|---|---|---|---|---|\n";
  for (const OptionInfo& info : ListOptions(options)) {
    const std::string range =
        info.choices.empty() ? RangeText(info) : fmt::format("{}", fmt::join(info.choices, ", "));
    page += fmt::format("| `{}` | {} | {} | {} | {} |\n", info.path, info.type,
                        EscapeTableCell(info.value), range, EscapeTableCell(info.help));
  }
  return page;
}

std::string NearestWord(std::string_view word, std::span<const std::string> candidates) {
  size_t best_distance = std::max<size_t>(2, word.size() / 3) + 1;
  std::string best;
  for (const std::string& candidate : candidates) {
    const size_t distance = EditDistance(word, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

}  // namespace enfilade
