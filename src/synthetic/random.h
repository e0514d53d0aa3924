// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include "enfilade/geometry/angles.h"

namespace enfilade {

/// One SplitMix64 step (Steele, Lea, Flood 2014): a bijection that scatters all bits.
[[nodiscard]] inline uint64_t ScatterBits(uint64_t z) {
  z += 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

/// Seed of a part, by its number, of something that has a seed.
[[nodiscard]] inline uint64_t PartSeed(uint64_t seed, uint64_t part) {
  return ScatterBits(seed ^ ScatterBits(part));
}

/// SplitMix64 stream. The standard's distributions differ between libraries; these do not.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(ScatterBits(seed)) {}

  [[nodiscard]] uint64_t Bits() { return ScatterBits(state_ += 0x9E3779B97F4A7C15u); }
  /// In [0, 1).
  [[nodiscard]] double Uniform() { return static_cast<double>(Bits() >> 11) * 0x1.0p-53; }
  [[nodiscard]] double Uniform(double low, double high) { return low + (high - low) * Uniform(); }
  /// As Uniform, rounded to millimetres: plans hold no more digits than a builder's.
  [[nodiscard]] double Millimetres(double low, double high) {
    return std::round(Uniform(low, high) * 1000) / 1000;
  }
  /// In 0 … count − 1.
  [[nodiscard]] int Index(int count) { return static_cast<int>(Uniform() * count); }
  /// One of the values; there must be some.
  template <typename Values>
  [[nodiscard]] auto& Pick(Values& values) {
    return values[static_cast<size_t>(Index(static_cast<int>(values.size())))];
  }
  [[nodiscard]] bool Chance(double probability) { return Uniform() < probability; }
  /// Standard normal (Box and Muller 1958).
  [[nodiscard]] double Normal() {
    const double radius = std::sqrt(-2 * std::log(1 - Uniform()));
    return radius * std::cos(2 * kPi * Uniform());
  }

 private:
  uint64_t state_;
};

}  // namespace enfilade
