// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/metric_scale.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

constexpr double kGivenSigma = 0.01;
constexpr double kUsualHeightSigma = 0.10;
constexpr double kUsualCeilingSigma = 0.12;
constexpr double kMinCeiling_m = 2.2, kMaxCeiling_m = 4.0;
constexpr double kMinHeight_m = 1.0, kMaxHeight_m = 2.0;
constexpr double kDisagreement = 3;

// Lintels and the tops of cabinets are level too, but lie below the ceiling.
double Highest(std::span<const double> ceilings) {
  return *std::max_element(ceilings.begin(), ceilings.end());
}

void Combine(MetricScale& scale) {
  double weight = 0, sum = 0;
  for (const ScaleCue& cue : scale.cues) {
    const double w = 1 / (cue.log_sigma * cue.log_sigma);
    weight += w;
    sum += w * std::log(cue.metres);
  }
  scale.camera_height_m = std::exp(sum / weight);
  scale.log_sigma = 1 / std::sqrt(weight);
}

void WarnOfDisagreement(MetricScale& scale) {
  for (const ScaleCue& cue : scale.cues) {
    const double apart = std::abs(std::log(cue.metres / scale.camera_height_m));
    if (apart < kDisagreement * cue.log_sigma) continue;
    scale.warnings.push_back(fmt::format(
        "the {} says that cameras stand at {:.2f} m, the scale that was taken at {:.2f} m",
        cue.name, cue.metres, scale.camera_height_m));
  }
}

void WarnOfImplausible(std::span<const double> ceilings, MetricScale& scale) {
  const double height_m = scale.camera_height_m;
  if (height_m < kMinHeight_m || height_m > kMaxHeight_m) {
    scale.warnings.push_back(fmt::format(
        "cameras stand at {:.2f} m, which is unusual: check --camera-height", height_m));
  }
  if (ceilings.empty()) return;
  const double ceiling_m = Highest(ceilings) * height_m;
  if (ceiling_m < kMinCeiling_m || ceiling_m > kMaxCeiling_m) {
    scale.warnings.push_back(fmt::format(
        "rooms come out {:.2f} m high, which is unusual: check --camera-height", ceiling_m));
  }
}

}  // namespace

MetricScale FindMetricScale(std::optional<double> given_height_m, std::span<const double> ceilings,
                            const ScaleOptions& options) {
  MetricScale scale;
  if (given_height_m) {
    scale.source = ScaleSource::kCameraHeight;
    scale.cues.push_back({"given camera height", *given_height_m, kGivenSigma});
  } else {
    scale.cues.push_back({"usual camera height", options.assumed_height_m, kUsualHeightSigma});
  }
  if (!ceilings.empty()) {
    scale.cues.push_back({"usual height of rooms", options.assumed_ceiling_m / Highest(ceilings),
                          kUsualCeilingSigma});
  }
  Combine(scale);
  // Usual sizes do not bend what the user has measured.
  if (given_height_m) scale.camera_height_m = *given_height_m;
  WarnOfDisagreement(scale);
  WarnOfImplausible(ceilings, scale);
  return scale;
}

}  // namespace enfilade
