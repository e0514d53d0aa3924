// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace enfilade {

/// Whether both features of a match are as large as their distances say, within a factor of 1.5.
/// `log_size_a` and `log_size_b` are as LogSizes tells them, `b_over_a` is the distance from b's
/// camera over that from a's. True where a size is unknown (NaN).
[[nodiscard]] inline bool FitSizes(double log_size_a, double log_size_b, double b_over_a) {
  const double larger = log_size_b - log_size_a + std::log(b_over_a);
  return !(std::abs(larger) > std::log(1.5));
}

}  // namespace enfilade
