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
  const double wrapped = rad - 2.0 * kPi * std::floor((rad + kPi) / (2.0 * kPi));
  return wrapped >= kPi ? -kPi : wrapped;  // just below −π, rounding gives +π
}

/// The angle modulo π/2 in [−π/4, π/4): the heading of a Manhattan frame.
[[nodiscard]] inline double WrapQuarter(double rad) {
  const double wrapped = rad - 0.5 * kPi * std::floor(rad / (0.5 * kPi) + 0.5);
  return wrapped >= 0.25 * kPi ? -0.25 * kPi : wrapped;
}

}  // namespace enfilade
