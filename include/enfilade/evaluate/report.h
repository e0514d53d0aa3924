// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "enfilade/evaluate/evaluate.h"
#include "enfilade/evaluate/types.h"

namespace enfilade {

/// How a figure is shown.
enum class FigureUnit { kCount, kShare, kMetres, kSquareMetres, kDegrees, kSeconds, kMegabytes };

/// Which way a figure is better. Neutral ones describe, or depend on the home's size.
enum class FigureSense { kHigherIsBetter, kLowerIsBetter, kNeutral };

struct FigureInfo {
  std::string_view key;
  std::string_view group;
  FigureUnit unit;
  FigureSense sense;
};

/// Every figure of docs/evaluation.md, group by group, in the order in which they are shown.
[[nodiscard]] std::span<const FigureInfo> FigureInfos();

/// All keys, none of them computed.
[[nodiscard]] MetricReport EmptyReport();

/// A table for the terminal: groups, keys, values with units, "n/a" where there is none. Groups
/// without any value are left out; keys that FigureInfos() lacks come last.
[[nodiscard]] std::string FormatReport(const MetricReport& report);

/// Flat object of all figures, null where there is none.
[[nodiscard]] nlohmann::json ReportToJson(const MetricReport& report);

/// As above, with "panoramas": the figures of each that has any, in the order of the views.
[[nodiscard]] nlohmann::json ReportToJson(const EvaluationReport& report);

}  // namespace enfilade
