// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/metric_scale.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

constexpr double kGivenSigma = 0.01;
constexpr double kTapeSigma = 0.005;
constexpr double kPlaceSigma = 0.02;  // of the distance of two cameras, camera heights
constexpr double kDoorSigma = 0.025;
constexpr double kUsualHeightSigma = 0.10;
constexpr double kUsualCeilingSigma = 0.12;
constexpr double kMinCeiling_m = 2.2, kMaxCeiling_m = 4.0;
constexpr double kMinHeight_m = 1.0, kMaxHeight_m = 2.0;
constexpr double kDisagreement = 3;

// Lintels and the tops of cabinets are level too, but lie below the ceiling.
double Highest(std::span<const double> ceilings) {
  return *std::max_element(ceilings.begin(), ceilings.end());
}

std::vector<ScaleCue> CuesOf(const ScaleEvidence& evidence, const ScaleOptions& options) {
  std::vector<ScaleCue> cues;
  if (evidence.given_height_m) {
    cues.push_back({"given camera height", *evidence.given_height_m, kGivenSigma, true});
  }
  for (const MeasuredDistance& distance : evidence.distances) {
    cues.push_back({"distance " + distance.name, distance.metres / distance.camera_heights,
                    std::hypot(kTapeSigma, kPlaceSigma / distance.camera_heights), true});
  }
  if (evidence.door_head) {
    cues.push_back({"door heads", options.assumed_door_m / *evidence.door_head, kDoorSigma});
  }
  if (!evidence.given_height_m) {
    cues.push_back({"usual camera height", options.assumed_height_m, kUsualHeightSigma});
  }
  if (!evidence.ceilings.empty()) {
    cues.push_back({"usual height of rooms", options.assumed_ceiling_m / Highest(evidence.ceilings),
                    kUsualCeilingSigma});
  }
  return cues;
}

// Usual sizes do not bend what the user has measured.
void Combine(MetricScale& scale) {
  const bool has_measured = std::any_of(scale.cues.begin(), scale.cues.end(),
                                        [](const ScaleCue& cue) { return cue.is_measured; });
  double weight = 0, sum = 0;
  for (ScaleCue& cue : scale.cues) {
    if (has_measured && !cue.is_measured) continue;
    cue.weight = 1 / (cue.log_sigma * cue.log_sigma);
    weight += cue.weight;
    sum += cue.weight * std::log(cue.metres);
  }
  for (ScaleCue& cue : scale.cues) cue.weight /= weight;
  scale.camera_height_m = std::exp(sum / weight);
  scale.log_sigma = 1 / std::sqrt(weight);
}

void WarnOfDisagreement(MetricScale& scale) {
  for (const ScaleCue& cue : scale.cues) {
    const double apart = std::abs(std::log(cue.metres / scale.camera_height_m));
    if (apart < kDisagreement * cue.log_sigma) continue;
    scale.warnings.push_back(
        fmt::format("scale: {} puts cameras at {:.2f} m, all that counts together at {:.2f} m",
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

MetricScale FindMetricScale(const ScaleEvidence& evidence, const ScaleOptions& options) {
  MetricScale scale;
  scale.cues = CuesOf(evidence, options);
  if (evidence.given_height_m) scale.source = ScaleSource::kCameraHeight;
  if (!evidence.distances.empty()) scale.source = ScaleSource::kKnownDistance;
  Combine(scale);
  // Without the last bit that exp(log(x)) may lose.
  if (evidence.given_height_m && evidence.distances.empty()) {
    scale.camera_height_m = *evidence.given_height_m;
  }
  WarnOfDisagreement(scale);
  WarnOfImplausible(evidence.ceilings, scale);
  return scale;
}

std::string DescribeCue(const ScaleCue& cue) {
  return fmt::format("{}: cameras stand at {:.3f} m ± {:.1f} %, weight {:.0f} %", cue.name,
                     cue.metres, 100 * cue.log_sigma, 100 * cue.weight);
}

}  // namespace enfilade
