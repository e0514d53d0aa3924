// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/evidence/accumulate.h"
#include "polar_view.h"

namespace enfilade {

/// No wall stands nearer to a camera, metres; a door may have been open for it and closed for the
/// others.
inline constexpr float kRoomRoundCamera = 0.4f;

struct CellLogOdds {
  float wall = 0;
  float free = 0;
};

/// What one view's distribution of the wall distance along a direction says about a cell at
/// distance r.
///
/// With F the distribution, o(r) the probability that the column is an outlier, and prior 1/2:
///   P(free)  = 1 − F(r) + F(r − depth)/2,  P(solid) = F(r) − F(r − depth)/2: just behind the wall
///   the cell is solid, farther behind nothing is known.
///   A wall face in the cell, with faces met at the rate 1/ℓ (mean free path) a priori, is
///   F(r⁻) + ℓ·ΔF/Δr times as likely as none: 0 in front of the wall, large at it, 1 behind it.
/// Outliers mix in what is known without looking, FreeIfUnexplained, and no face. The outlier rate
/// grows with the distance, 1 − o = (1 − o₀)/(1 + (r/R)²), so near views count more.
class SensorModel {
 public:
  explicit SensorModel(const AccumulateOptions& options);

  [[nodiscard]] CellLogOdds Evaluate(const PolarReading& reading, float r_m, float half_width_m,
                                     double weight) const;

  /// Probability that a cell is free when the column to it tells nothing of its wall: a room is
  /// rarely narrower than a camera needs. 1 up to kRoomRoundCamera, ½ from 1.5 m.
  [[nodiscard]] static float FreeIfUnexplained(float r_m);

  /// Rounded to a multiple of 2⁻¹⁰, so that single-precision sums are exact in any order.
  [[nodiscard]] static float Quantised(double log_odds);

 private:
  float inlier_;
  float inverse_range2_;
  float mean_free_path_m_;
  float limit_;
};

}  // namespace enfilade
