// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "enfilade/evaluate/report.h"
#include "enfilade/evaluate/types.h"
#include "enfilade/floorplan/types.h"

namespace enfilade {

/// How a method of a comparison ended.
enum class MethodOutcome {
  kFound,
  kNoResult,     ///< it worked, and the answer is that there is none
  kOutOfTime,    ///< given up at the limit
  kOutOfMemory,  ///< given up at the limit
  kFailed,
};
[[nodiscard]] std::span<const std::string_view> EnumNames(MethodOutcome);

/// One of several methods for the same home, and what came of it.
struct ComparedMethod {
  std::string name;   ///< of its folder: "cut_lambda100"
  std::string title;  ///< for people: "2D cut, λ = 100"
  MethodOutcome outcome = MethodOutcome::kFailed;
  std::string reason;  ///< one line; empty when there is a result
  /// Those of Evaluate where there is a truth; and rooms, corners, faces, seconds and
  /// peak_memory_mb.
  MetricReport figures;
  Floorplan plan;            ///< empty unless found
  std::string outside_jpeg;  ///< the model from two viewpoints (model_view.h); empty without one
  std::string inside_jpeg;
};

/// A column of the table of methods.
struct ComparedFigure {
  std::string_view key;   ///< into ComparedMethod::figures
  std::string_view head;  ///< "area error, %"
  std::string_view meaning;
  double scale = 1;  ///< from the figure to the unit of the head
  int num_decimals = 0;
  FigureSense sense = FigureSense::kLowerIsBetter;
};

[[nodiscard]] std::span<const ComparedFigure> ComparedFigures();

/// Rooms, corners and faces of a method's plan and model, by the keys of ComparedFigures.
void AddSizes(const Floorplan& plan, size_t num_faces, MetricReport& figures);

/// What stands where there is no figure.
inline constexpr std::string_view kNoFigure = "–";

/// The figure in the unit and with the decimals of its column, or kNoFigure.
[[nodiscard]] std::string ComparedText(const ComparedFigure& column, const ComparedMethod& method);

/// For each method whether its text in this column is the best of those that found a result.
[[nodiscard]] std::vector<bool> BestOf(const ComparedFigure& column,
                                       std::span<const ComparedMethod> methods);

/// Name of the method that the others are compared with.
inline constexpr std::string_view kFullSolver = "full";

/// One sentence on a comparison.
struct Verdict {
  std::string text;
  bool is_good = false;
};

/// Whether the full solver's area error is below every rival's and, if not, below whose it is not;
/// then which methods have no result, and why.
[[nodiscard]] std::vector<Verdict> Verdicts(std::span<const ComparedMethod> methods);

/// A table for the terminal, a row a method, the best of each column with an asterisk, and the
/// verdicts.
[[nodiscard]] std::string FormatComparison(std::span<const ComparedMethod> methods);

/// "methods": name, title, outcome, reason and all figures of each, null where there is none;
/// "verdicts": the sentences.
[[nodiscard]] nlohmann::json ComparisonToJson(std::span<const ComparedMethod> methods);

}  // namespace enfilade
