// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

namespace enfilade {

inline constexpr double kPi = std::numbers::pi;

[[nodiscard]] constexpr double DegToRad(double deg) { return deg * (kPi / 180.0); }
[[nodiscard]] constexpr double RadToDeg(double rad) { return rad * (180.0 / kPi); }

/// The angle modulo 2π in [−π, π).
[[nodiscard]] inline double WrapPi(double rad) {
  return rad - 2.0 * kPi * std::floor((rad + kPi) / (2.0 * kPi));
}

/// The angle modulo π/2 in [−π/4, π/4): the heading of a Manhattan frame.
[[nodiscard]] inline double WrapQuarter(double rad) {
  return rad - 0.5 * kPi * std::floor(rad / (0.5 * kPi) + 0.5);
}

}  // namespace enfilade
