// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace enfilade {
namespace {

constexpr std::string_view kNone = "–";
constexpr std::string_view kAreaError = "area_error_gross";

constexpr ComparedFigure kFigures[] = {
    {kAreaError, "area error, %", "too much and missed area, as share of the true area (gross)",
     100, 2},
    {"wall_plan_to_truth_median_m", "plan to true wall, cm",
     "median distance from the plan's walls to true ones", 100, 1},
    {"wall_truth_to_plan_median_m", "true wall to plan, cm",
     "median distance from the true walls to the plan's", 100, 1},
    {"wall_within_10cm", "true walls found, %", "share of the true walls with one within 10 cm",
     100, 0, FigureSense::kHigherIsBetter},
    {"depth_median_m", "depth error, cm",
     "median over the panoramas' pixels, the model rendered from where they were taken", 100, 1},
    {"depth_within_5pct", "depth within 5 %, %", "share of these pixels", 100, 0,
     FigureSense::kHigherIsBetter},
    {"normal_median_deg", "normal error, °", "median over the same pixels", 1, 1},
    {"rooms", "rooms", "rooms of the plan", 1, 0, FigureSense::kNeutral},
    {"corners", "corners", "corners of the plan", 1, 0},
    {"faces", "faces", "planar pieces of the model", 1, 0},
    {"seconds", "time, s", "from wall profiles and points to plan or surface", 1, 1},
    {"peak_memory_mb", "memory, MB", "most resident memory of its process", 1, 0},
};

std::optional<double> FigureOf(const ComparedMethod& method, std::string_view key) {
  const auto figure = method.figures.find(std::string(key));
  if (figure == method.figures.end() || !figure->second || !std::isfinite(*figure->second))
    return std::nullopt;
  return figure->second;
}

std::string PercentText(double share, int num_decimals = 2) {
  return fmt::format("{:.{}f} %", 100 * share, num_decimals);
}

// As many decimals as tell two shares apart.
int DecimalsBetween(double a, double b) {
  constexpr int kMost = 6;
  int num_decimals = 2;
  while (num_decimals < kMost && PercentText(a, num_decimals) == PercentText(b, num_decimals))
    ++num_decimals;
  return num_decimals;
}

std::string FirstUpper(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 32);
  return text;
}

// "a, b and c".
std::string Listed(const std::vector<std::string>& items) {
  std::string text;
  for (size_t i = 0; i < items.size(); ++i) {
    if (i > 0) text += i + 1 == items.size() ? " and " : ", ";
    text += items[i];
  }
  return text;
}

std::optional<Verdict> VerdictOnArea(std::span<const ComparedMethod> methods) {
  const auto full = std::find_if(methods.begin(), methods.end(), [](const ComparedMethod& method) {
    return method.name == kFullSolver;
  });
  if (full == methods.end()) return std::nullopt;
  const std::optional<double> own = FigureOf(*full, kAreaError);
  if (!own) return std::nullopt;
  std::vector<std::string> not_above;
  const ComparedMethod* next = nullptr;
  for (const ComparedMethod& rival : methods) {
    const std::optional<double> error = FigureOf(rival, kAreaError);
    if (&rival == &*full || !error) continue;
    if (*error <= *own)
      not_above.push_back(fmt::format("{} ({})", rival.title, PercentText(*error)));
    if (next == nullptr || *error < *FigureOf(*next, kAreaError)) next = &rival;
  }
  if (next == nullptr) return std::nullopt;
  if (not_above.empty()) {
    const double nearest = *FigureOf(*next, kAreaError);
    const int num_decimals = DecimalsBetween(*own, nearest);
    return Verdict{
        fmt::format(
            "The full solver's area error, {}, is below that of every rival; the next is {} with "
            "{}.",
            PercentText(*own, num_decimals), next->title, PercentText(nearest, num_decimals)),
        true};
  }
  return Verdict{fmt::format("The full solver's area error, {}, is not below that of {}.",
                             PercentText(*own), Listed(not_above)),
                 false};
}

std::string_view HowItEnded(MethodOutcome outcome) {
  switch (outcome) {
    case MethodOutcome::kNoResult:
      return "found nothing";
    case MethodOutcome::kOutOfTime:
    case MethodOutcome::kOutOfMemory:
      return "gave up";
    default:
      return "failed";
  }
}

// Columns as people count them: bytes that begin a character.
size_t NumCharacters(std::string_view text) {
  return static_cast<size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

// The words of a column's head, its unit last.
std::vector<std::string> WordsOf(std::string_view head) {
  std::vector<std::string> words(1);
  for (const char c : head) {
    if (c == ' ') {
      words.emplace_back();
    } else if (c != ',') {
      words.back() += c;
    }
  }
  return words;
}

std::string Padding(std::string_view text, size_t width) {
  const size_t length = NumCharacters(text);
  return std::string(width > length ? width - length : 0, ' ');
}

}  // namespace

std::span<const std::string_view> EnumNames(MethodOutcome) {
  static constexpr std::array<std::string_view, 5> kNames = {"found", "no_result", "out_of_time",
                                                             "out_of_memory", "failed"};
  return kNames;
}

std::span<const ComparedFigure> ComparedFigures() { return kFigures; }

void AddSizes(const Floorplan& plan, size_t num_faces, MetricReport& figures) {
  size_t num_rooms = 0, num_corners = 0;
  for (const Storey& storey : plan.storeys) {
    num_rooms += storey.rooms.size();
    for (const Room& room : storey.rooms) {
      for (const Ring2& ring : RingsOf(room.polygon)) num_corners += ring.size();
    }
  }
  figures["rooms"] = static_cast<double>(num_rooms);
  figures["corners"] = static_cast<double>(num_corners);
  figures["faces"] = static_cast<double>(num_faces);
}

std::string ComparedText(const ComparedFigure& column, const ComparedMethod& method) {
  const std::optional<double> figure = FigureOf(method, column.key);
  if (!figure) return std::string(kNone);
  return fmt::format("{:.{}f}", *figure * column.scale, column.num_decimals);
}

std::vector<bool> BestOf(const ComparedFigure& column, std::span<const ComparedMethod> methods) {
  std::vector<bool> are_best(methods.size());
  if (column.sense == FigureSense::kNeutral) return are_best;
  const ComparedMethod* best = nullptr;
  for (const ComparedMethod& method : methods) {
    const std::optional<double> figure = FigureOf(method, column.key);
    if (!figure || method.outcome != MethodOutcome::kFound) continue;
    const bool is_better = best == nullptr || (column.sense == FigureSense::kLowerIsBetter
                                                   ? *figure < *FigureOf(*best, column.key)
                                                   : *figure > *FigureOf(*best, column.key));
    if (is_better) best = &method;
  }
  if (best == nullptr) return are_best;
  for (size_t i = 0; i < methods.size(); ++i) {
    are_best[i] = methods[i].outcome == MethodOutcome::kFound &&
                  ComparedText(column, methods[i]) == ComparedText(column, *best);
  }
  return are_best;
}

std::vector<Verdict> Verdicts(std::span<const ComparedMethod> methods) {
  std::vector<Verdict> verdicts;
  if (std::optional<Verdict> area = VerdictOnArea(methods)) verdicts.push_back(std::move(*area));
  for (const ComparedMethod& method : methods) {
    if (method.outcome == MethodOutcome::kFound) continue;
    verdicts.push_back({fmt::format("{} {}: {}.", FirstUpper(method.title),
                                    HowItEnded(method.outcome), method.reason),
                        false});
  }
  return verdicts;
}

std::string FormatComparison(std::span<const ComparedMethod> methods) {
  size_t name_width = 0;
  for (const ComparedMethod& method : methods)
    name_width = std::max(name_width, NumCharacters(method.title));
  std::vector<std::vector<std::string>> heads;
  std::vector<size_t> widths;
  size_t num_lines = 0;
  for (const ComparedFigure& column : kFigures) {
    heads.push_back(WordsOf(column.head));
    num_lines = std::max(num_lines, heads.back().size());
    widths.push_back(0);
    for (const std::string& word : heads.back())
      widths.back() = std::max(widths.back(), NumCharacters(word));
    for (const ComparedMethod& method : methods)
      widths.back() = std::max(widths.back(), NumCharacters(ComparedText(column, method)));
  }
  std::string text;
  const auto end_line = [&] {
    while (text.back() == ' ') text.pop_back();
    text += '\n';
  };
  for (size_t line = 0; line < num_lines; ++line) {
    text += std::string(name_width, ' ');
    for (size_t k = 0; k < heads.size(); ++k) {
      const size_t above = num_lines - heads[k].size();
      const std::string word = line < above ? "" : heads[k][line - above];
      text += "  " + Padding(word, widths[k]) + word + ' ';
    }
    end_line();
  }
  for (size_t i = 0; i < methods.size(); ++i) {
    text += methods[i].title + Padding(methods[i].title, name_width);
    for (size_t k = 0; k < heads.size(); ++k) {
      const std::string figure = ComparedText(kFigures[k], methods[i]);
      text += "  " + Padding(figure, widths[k]) + figure;
      text += BestOf(kFigures[k], methods)[i] ? '*' : ' ';
    }
    end_line();
  }
  text += "* the best of its column\n";
  for (const Verdict& verdict : Verdicts(methods)) text += verdict.text + '\n';
  return text;
}

nlohmann::json ComparisonToJson(std::span<const ComparedMethod> methods) {
  nlohmann::json rows = nlohmann::json::array();
  for (const ComparedMethod& method : methods) {
    nlohmann::json figures = ReportToJson(method.figures);
    for (const ComparedFigure& column : kFigures) {
      const std::optional<double> figure = FigureOf(method, column.key);
      figures[std::string(column.key)] = figure ? nlohmann::json(*figure) : nlohmann::json();
    }
    rows.push_back({{"name", method.name},
                    {"title", method.title},
                    {"outcome", EnumNames(method.outcome)[static_cast<size_t>(method.outcome)]},
                    {"reason", method.reason},
                    {"figures", std::move(figures)}});
  }
  nlohmann::json sentences = nlohmann::json::array();
  for (const Verdict& verdict : Verdicts(methods)) sentences.push_back(verdict.text);
  return {{"methods", std::move(rows)}, {"verdicts", std::move(sentences)}};
}

}  // namespace enfilade
