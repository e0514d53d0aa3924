// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace enfilade {
namespace {

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

constexpr int kFewestDecimals = 2, kMostDecimals = 6;

std::string PercentText(double share, int num_decimals) {
  return fmt::format("{:.{}f} %", 100 * share, num_decimals);
}

// As many decimals as tell two shares apart.
int DecimalsBetween(double a, double b) {
  int num_decimals = kFewestDecimals;
  while (num_decimals < kMostDecimals &&
         PercentText(a, num_decimals) == PercentText(b, num_decimals))
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

struct AreaError {
  std::string_view title;
  double share = 0;
};

std::optional<Verdict> VerdictOnArea(std::span<const ComparedMethod> methods) {
  std::optional<double> own;
  std::vector<AreaError> rivals, not_above;
  for (const ComparedMethod& method : methods) {
    const std::optional<double> error = FigureOf(method, kAreaError);
    if (!error) continue;
    if (method.name == kFullSolver) {
      own = error;
    } else {
      rivals.push_back({method.title, *error});
    }
  }
  if (!own || rivals.empty()) return std::nullopt;
  std::copy_if(rivals.begin(), rivals.end(), std::back_inserter(not_above),
               [&](const AreaError& rival) { return rival.share <= *own; });
  if (not_above.empty()) {
    const AreaError& next =
        *std::min_element(rivals.begin(), rivals.end(),
                          [](const AreaError& a, const AreaError& b) { return a.share < b.share; });
    const int num_decimals = DecimalsBetween(*own, next.share);
    return Verdict{
        fmt::format(
            "The full solver's area error, {}, is below that of every rival; the next is {} with "
            "{}.",
            PercentText(*own, num_decimals), next.title, PercentText(next.share, num_decimals)),
        true};
  }
  int num_decimals = kFewestDecimals;
  for (const AreaError& rival : not_above) {
    if (rival.share < *own)
      num_decimals = std::max(num_decimals, DecimalsBetween(*own, rival.share));
  }
  std::vector<std::string> names;
  for (const AreaError& rival : not_above)
    names.push_back(fmt::format("{} ({})", rival.title, PercentText(rival.share, num_decimals)));
  return Verdict{fmt::format("The full solver's area error, {}, is not below that of {}.",
                             PercentText(*own, num_decimals), Listed(names)),
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

// A column of the table for the terminal. Texts end in a place for the asterisk.
struct TextColumn {
  std::vector<std::string> head;   // its lines
  std::vector<std::string> cells;  // a method each
  size_t width = 0;
};

TextColumn TextColumnOf(const ComparedFigure& figure, std::span<const ComparedMethod> methods) {
  TextColumn column;
  for (const std::string& word : WordsOf(figure.head)) column.head.push_back(word + ' ');
  const std::vector<bool> are_best = BestOf(figure, methods);
  for (size_t i = 0; i < methods.size(); ++i)
    column.cells.push_back(ComparedText(figure, methods[i]) + (are_best[i] ? '*' : ' '));
  for (const std::vector<std::string>* texts : {&column.head, &column.cells}) {
    for (const std::string& text : *texts)
      column.width = std::max(column.width, NumCharacters(text));
  }
  return column;
}

template <typename CellOf>
std::string TableLine(std::string_view title, size_t title_width,
                      const std::vector<TextColumn>& columns, const CellOf& cell_of) {
  std::string line = std::string(title) + Padding(title, title_width);
  for (const TextColumn& column : columns) {
    const std::string cell = cell_of(column);
    line += "  " + Padding(cell, column.width) + cell;
  }
  while (line.back() == ' ') line.pop_back();
  return line + '\n';
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
  if (!figure) return std::string(kNoFigure);
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
  size_t title_width = 0, num_head_lines = 0;
  for (const ComparedMethod& method : methods)
    title_width = std::max(title_width, NumCharacters(method.title));
  std::vector<TextColumn> columns;
  for (const ComparedFigure& figure : kFigures) {
    columns.push_back(TextColumnOf(figure, methods));
    num_head_lines = std::max(num_head_lines, columns.back().head.size());
  }
  std::string text;
  for (size_t line = 0; line < num_head_lines; ++line) {
    text += TableLine("", title_width, columns, [&](const TextColumn& column) {
      const size_t num_above = num_head_lines - column.head.size();
      return line < num_above ? "" : column.head[line - num_above];
    });
  }
  for (size_t i = 0; i < methods.size(); ++i) {
    text += TableLine(methods[i].title, title_width, columns,
                      [&](const TextColumn& column) { return column.cells[i]; });
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
