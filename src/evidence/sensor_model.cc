// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_model.h"

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

constexpr float kUnknownFrom = 1.5f;  // metres; beyond, nothing is known without looking

}  // namespace

SensorModel::SensorModel(const AccumulateOptions& options)
    : inlier_(static_cast<float>(1 - options.outlier_probability)),
      inverse_range2_(
          static_cast<float>(1 / (options.half_trust_range_m * options.half_trust_range_m))),
      mean_free_path_m_(static_cast<float>(options.mean_free_path_m)),
      limit_(static_cast<float>(options.max_view_log_odds)) {}

float SensorModel::Quantised(double log_odds) {
  return static_cast<float>(std::nearbyint(log_odds * 1024) / 1024);
}

float SensorModel::FreeIfUnexplained(float r_m) {
  if (r_m <= kRoomRoundCamera) return 1;
  if (r_m >= kUnknownFrom) return 0.5f;  // most cells; a logarithm for each would be felt
  static const float octaves = std::log2(kUnknownFrom / kRoomRoundCamera);
  return 1 - 0.5f * std::log2(r_m / kRoomRoundCamera) / octaves;
}

CellLogOdds SensorModel::Evaluate(const PolarReading& reading, float r_m, float half_width_m,
                                  double weight) const {
  const float inlier = reading.trust * inlier_ / (1 + r_m * r_m * inverse_range2_);
  const float unknown = FreeIfUnexplained(r_m) * (1 - inlier);
  const float p_free = inlier * (1 - reading.cdf + 0.5f * reading.cdf_blocked) + unknown;
  const float density = (reading.cdf_far - reading.cdf_near) / (2 * half_width_m);
  const float face_ratio = inlier * (reading.cdf_near + mean_free_path_m_ * density) + (1 - inlier);
  const auto clamped = [&](float log_odds) { return std::clamp(log_odds, -limit_, limit_); };
  return {Quantised(weight * clamped(std::log(face_ratio))),
          Quantised(weight * clamped(std::log(p_free / (1 - p_free))))};
}

}  // namespace enfilade
