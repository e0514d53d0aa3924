// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/evaluate/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace enfilade {

std::optional<double> Quantile(std::vector<double> values, double q) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const double position = q * static_cast<double>(values.size() - 1);
  const size_t below = static_cast<size_t>(position);
  const double part = position - static_cast<double>(below);
  double value = values[below];
  if (part > 0) value += part * (values[below + 1] - values[below]);
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<double> Mean(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace enfilade
