// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "enfilade/evaluate/types.h"

namespace enfilade {

/// One home of a batch.
struct JudgedHome {
  std::string name;
  std::string error;     ///< why it has no figures; empty when it has
  MetricReport figures;  ///< empty when it failed
};

/// One figure over all homes that have it.
struct FigureSummary {
  std::string_view key;
  int num_homes = 0;
  std::optional<double> mean;
  std::optional<double> worst;  ///< none where neither high nor low is better
  std::string worst_home;       ///< the first of those that share the worst
};

/// The figures of docs/evaluation.md that some home has, in their order. Homes that failed have
/// none: look at their number first.
[[nodiscard]] std::vector<FigureSummary> SummariseBatch(std::span<const JudgedHome> homes);

/// "homes": name, error and figures of each; "failed": their number; "summary": mean, worst, worst
/// home and number of homes by figure.
[[nodiscard]] nlohmann::json BatchToJson(std::span<const JudgedHome> homes);

/// A line a home (RFC 4180): name, error, then all figures, empty where there is none.
[[nodiscard]] std::string BatchToCsv(std::span<const JudgedHome> homes);

/// The summary as a table, and the homes that failed.
[[nodiscard]] std::string BatchToMarkdown(std::span<const JudgedHome> homes);

}  // namespace enfilade
