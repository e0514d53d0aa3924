// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

namespace enfilade {

/// The q-quantile (0 ≤ q ≤ 1) by linear interpolation between order statistics (Hyndman and Fan
/// 1996, type 7); none for no values or where it falls on an infinite one. No value may be NaN.
[[nodiscard]] std::optional<double> Quantile(std::vector<double> values, double q);

[[nodiscard]] inline std::optional<double> Median(std::vector<double> values) {
  return Quantile(std::move(values), 0.5);
}

/// None for no values.
[[nodiscard]] std::optional<double> Mean(const std::vector<double>& values);

}  // namespace enfilade
