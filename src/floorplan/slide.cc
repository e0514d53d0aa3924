// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/slide.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <vector>

#include "enfilade/image/sampling.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr double kGateDistance_m = 0.06;  // where free and solid are looked for, beside the face
constexpr double kMinEdge_m = 0.05;
constexpr float kMinPeak = 0.2F;  // mean log-odds along the edge
constexpr float kSeenLogOdds = 0.5F;

float Sample(const GridFrame& frame, const ImageF& image, const Vector2d& p) {
  const Vector2d pixel = (p - frame.origin) / frame.cell_m;
  return SampleBilinear(image, pixel.x(), pixel.y());
}

/// How much a face at `p`, seen from the side that `normal` points to, is believed: wall evidence,
/// with more free space before it than behind it.
float FaceAt(const LoopField& field, const Vector2d& p, const Vector2d& normal) {
  const float before = Sample(field.frame, field.freeness, p + kGateDistance_m * normal);
  const float behind = Sample(field.frame, field.freeness, p - kGateDistance_m * normal);
  return std::max(Sample(field.frame, field.wall, p), 0.0F) *
         std::clamp(before - behind, 0.0F, 1.0F);
}

bool EdgesTouch(const Ring2& a, const Ring2& b) {
  for (const Vector2d& p : a) {
    for (size_t i = 0; i < b.size(); ++i) {
      if (DistanceToSegment(p, b[i], b[(i + 1) % b.size()]) < kMinEdge_m) return true;
    }
  }
  return false;
}

bool IsValid(const Polygon2& polygon, size_t ring_idx) {
  const Ring2& ring = ring_idx == 0 ? polygon.outer : polygon.holes[ring_idx - 1];
  for (size_t i = 0; i < ring.size(); ++i) {
    if ((ring[(i + 1) % ring.size()] - ring[i]).norm() < 1e-3) return false;
  }
  if (!IsSimple(ring)) return false;
  if (ring_idx > 0 && !Contains(polygon.outer, ring[0])) return false;
  for (size_t k = 0; k <= polygon.holes.size(); ++k) {
    if (k == ring_idx) continue;
    const Ring2& other = k == 0 ? polygon.outer : polygon.holes[k - 1];
    if (EdgesTouch(ring, other) || EdgesTouch(other, ring)) return false;
  }
  return true;
}

int SlideRing(const LoopField& field, double reach_m, size_t ring_idx, Polygon2& polygon) {
  Ring2& ring = ring_idx == 0 ? polygon.outer : polygon.holes[ring_idx - 1];
  const size_t n = ring.size();
  const Ring2 original = ring;
  const auto length = [&](size_t i) { return (original[(i + 1) % n] - original[i]).norm(); };
  std::vector<size_t> order(n);
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return length(a) > length(b); });
  int num_moved = 0;
  for (const size_t i : order) {
    const size_t j = (i + 1) % n;
    const WallBand band = MeasureWallBand(field, original[i], original[j], reach_m);
    if (!band.has_peak) continue;
    const Vector2d direction = (original[j] - original[i]).normalized();
    const Vector2d shift = band.offset_m * Vector2d(-direction.y(), direction.x());
    // A neighbour edge must not turn round.
    const size_t before = (i + n - 1) % n, after = (j + 1) % n;
    const Vector2d old_in = ring[i] - ring[before], old_out = ring[after] - ring[j];
    const Vector2d new_in = old_in + shift, new_out = old_out - shift;
    if (old_in.dot(new_in) <= 0 || old_out.dot(new_out) <= 0) continue;
    ring[i] += shift;
    ring[j] += shift;
    if (IsValid(polygon, ring_idx)) {
      ++num_moved;
    } else {
      ring[i] -= shift;
      ring[j] -= shift;
    }
  }
  return num_moved;
}

/// Centre and width of the highest peak of values at offsets -n … n times `step`. Log-odds of
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
  double sum = 0, moment = 0, second_moment = 0;
  for (auto value = first; value != last; ++value) {
    const double weight = *value - base,
                 offset = (static_cast<double>(value - values.begin()) - center) * step;
    sum += weight;
    moment += weight * offset;
    second_moment += weight * offset * offset;
  }
  band.offset_m = moment / sum;
  band.sigma_m = std::sqrt(std::max(0.0, second_moment / sum - band.offset_m * band.offset_m));
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

int SlideToEvidence(const LoopField& field, double reach_m, Polygon2& polygon) {
  int num_moved = 0;
  for (size_t k = 0; k <= polygon.holes.size(); ++k)
    num_moved += SlideRing(field, reach_m, k, polygon);
  return num_moved;
}

}  // namespace enfilade
