// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/wall_band.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "enfilade/image/sampling.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kGateDistance_m = 0.06;  // where free and solid are looked for, beside the face
constexpr float kMinPeak = 0.2F;          // mean log-odds along the edge
constexpr float kSeenLogOdds = 0.5F;

float Sample(const GridFrame& frame, const ImageF& image, const Vector2d& p) {
  const Vector2d pixel = (p - frame.origin) / frame.cell_m;
  return SampleBilinear(image, pixel.x(), pixel.y());
}

/// How much a face at `p`, seen from the side that `normal` points to, is believed: wall evidence,
/// with more free space before it than behind it.
float FaceAt(const LoopField& field, const Vector2d& p, const Vector2d& normal) {
  const float wall = std::max(Sample(field.frame, field.wall, p), 0.0F);
  const float before = Sample(field.frame, field.freeness, p + kGateDistance_m * normal);
  const float behind = Sample(field.frame, field.freeness, p - kGateDistance_m * normal);
  return wall * std::clamp(before - behind, 0.0F, 1.0F);
}

/// Centre of the highest peak of values at offsets -n … n times `step`. Log-odds of
/// several views add up to a log-likelihood; its part above half of the peak is symmetric about the
/// face.
void LocatePeak(const std::vector<float>& values, double step, WallBand& band) {
  const auto peak = std::max_element(values.begin(), values.end());
  if (*peak < kMinPeak) return;
  band.has_peak = true;
  const float base = 0.5F * *peak;
  const auto is_low = [&](float value) { return value <= base; };
  const auto last = std::find_if(peak, values.end(), is_low);
  const auto first = std::find_if(std::make_reverse_iterator(peak), values.rend(), is_low).base();
  const double center = 0.5 * static_cast<double>(values.size() - 1);
  double sum = 0, moment = 0;
  for (auto value = first; value != last; ++value) {
    const double weight = *value - base,
                 offset = (static_cast<double>(value - values.begin()) - center) * step;
    sum += weight;
    moment += weight * offset;
  }
  band.offset_m = moment / sum;
}

}  // namespace

WallBand MeasureWallBand(const LoopField& field, const Vector2d& a, const Vector2d& b,
                         double reach_m) {
  const double length = (b - a).norm(), step = 0.5 * field.frame.cell_m;
  const Vector2d direction = (b - a) / length, normal(-direction.y(), direction.x());
  const double inset = std::min(0.1, 0.2 * length);  // corners mix the evidence of two walls
  const int num_along = std::max(1, static_cast<int>((length - 2 * inset) / step));
  const int num_side = static_cast<int>(std::lround(reach_m / step));
  std::vector<float> face(static_cast<size_t>(2 * num_side + 1));
  WallBand band;
  int num_seen = 0;
  for (int k = 0; k < num_along; ++k) {
    const Vector2d p = a + (inset + (length - 2 * inset) * (k + 0.5) / num_along) * direction;
    float at_segment = 0;
    for (int t = -num_side; t <= num_side; ++t) {
      const float value = FaceAt(field, p + t * step * normal, normal);
      face[static_cast<size_t>(t + num_side)] += value / static_cast<float>(num_along);
      if (std::abs(t) <= 2) at_segment = std::max(at_segment, value);
    }
    num_seen += at_segment > kSeenLogOdds;
  }
  band.seen_share = static_cast<double>(num_seen) / num_along;
  LocatePeak(face, step, band);
  return band;
}

}  // namespace enfilade
