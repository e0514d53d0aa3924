// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "enfilade/evaluate/report.h"

namespace enfilade {
namespace {

std::optional<double> FigureOf(const JudgedHome& home, std::string_view key) {
  const auto entry = home.figures.find(std::string(key));
  return entry != home.figures.end() ? entry->second : std::nullopt;
}

FigureSummary Summarise(std::span<const JudgedHome> homes, const FigureInfo& info) {
  FigureSummary summary;
  summary.key = info.key;
  double sum = 0;
  for (const JudgedHome& home : homes) {
    const std::optional<double> value = FigureOf(home, info.key);
    if (!value) continue;
    ++summary.num_homes;
    sum += *value;
    const bool is_worse =
        !summary.worst || (info.sense == FigureSense::kHigherIsBetter ? *value < *summary.worst
                                                                      : *value > *summary.worst);
    if (info.sense == FigureSense::kNeutral || !is_worse) continue;
    summary.worst = value;
    summary.worst_home = home.name;
  }
  if (summary.num_homes > 0) summary.mean = sum / summary.num_homes;
  return summary;
}

int64_t CountFailed(std::span<const JudgedHome> homes) {
  return std::count_if(homes.begin(), homes.end(), [](const auto& h) { return !h.error.empty(); });
}

std::string CsvField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string MarkdownCell(const std::string& text) {
  std::string cell;
  for (const char c : text) {
    if (c == '|') cell += '\\';
    cell += c;
  }
  return cell;
}

std::string Shown(const std::optional<double>& value) {
  return value ? fmt::format("{:.4g}", *value) : std::string();
}

}  // namespace

std::vector<FigureSummary> SummariseBatch(std::span<const JudgedHome> homes) {
  std::vector<FigureSummary> summaries;
  for (const FigureInfo& info : FigureInfos()) {
    FigureSummary summary = Summarise(homes, info);
    if (summary.num_homes > 0) summaries.push_back(std::move(summary));
  }
  return summaries;
}

nlohmann::json BatchToJson(std::span<const JudgedHome> homes) {
  nlohmann::json json = {{"homes", nlohmann::json::array()},
                         {"failed", CountFailed(homes)},
                         {"summary", nlohmann::json::object()}};
  for (const JudgedHome& home : homes) {
    json["homes"].push_back(
        {{"name", home.name}, {"error", home.error}, {"figures", ReportToJson(home.figures)}});
  }
  for (const FigureSummary& summary : SummariseBatch(homes)) {
    nlohmann::json& entry = json["summary"][std::string(summary.key)];
    entry = ReportToJson(MetricReport{{"mean", summary.mean}, {"worst", summary.worst}});
    entry["worst_home"] = summary.worst_home;
    entry["homes"] = summary.num_homes;
  }
  return json;
}

std::string BatchToCsv(std::span<const JudgedHome> homes) {
  std::string csv = "name,error";
  for (const FigureInfo& info : FigureInfos()) csv += fmt::format(",{}", info.key);
  csv += "\r\n";
  for (const JudgedHome& home : homes) {
    csv += CsvField(home.name) + "," + CsvField(home.error);
    for (const FigureInfo& info : FigureInfos()) {
      const std::optional<double> value = FigureOf(home, info.key);
      csv += value ? fmt::format(",{}", *value) : std::string(",");
    }
    csv += "\r\n";
  }
  return csv;
}

std::string BatchToMarkdown(std::span<const JudgedHome> homes) {
  std::string text =
      fmt::format("{} homes, {} of them failed.\n\n", homes.size(), CountFailed(homes));
  text += "| figure | mean | worst | worst home | homes |\n|---|--:|--:|---|--:|\n";
  for (const FigureSummary& summary : SummariseBatch(homes)) {
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", summary.key, Shown(summary.mean),
                        Shown(summary.worst), MarkdownCell(summary.worst_home), summary.num_homes);
  }
  if (CountFailed(homes) == 0) return text;
  text += "\n| failed | why |\n|---|---|\n";
  for (const JudgedHome& home : homes) {
    if (home.error.empty()) continue;
    text += fmt::format("| {} | {} |\n", MarkdownCell(home.name), MarkdownCell(home.error));
  }
  return text;
}

}  // namespace enfilade
