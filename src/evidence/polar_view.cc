// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "polar_view.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

constexpr double kTableStep = 0.01;   // metres, of the bin lookup
constexpr float kNegligible = 1e-3f;  // probability that changes log-odds by 0.01 at most
constexpr int kAzimuthStepsPerColumn = 4;
// Neighbouring columns belong to one surface when it would be seen at more than this grazing angle.
constexpr float kMinGrazingTangent = 0.07f;  // 4°

double NormalCdf(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

}  // namespace

double DistanceError::Sigma(double r_m) const {
  const double h = camera_height_m;
  return std::hypot(position_sigma_m, angle_sigma_rad * (r_m * r_m + h * h) / h);
}

RangeBins::RangeBins(const std::vector<double>& bin_m, const DistanceError& error) {
  const size_t n = bin_m.size();
  ENFILADE_CHECK(n >= 2 && bin_m.front() > 0);
  for (size_t i = 0; i + 1 < n; ++i) ENFILADE_CHECK(bin_m[i] < bin_m[i + 1]);

  std::vector<double> edge(n + 1);
  for (size_t i = 1; i < n; ++i) edge[i] = 0.5 * (bin_m[i - 1] + bin_m[i]);
  edge[0] = std::max(0.0, 1.5 * bin_m[0] - 0.5 * bin_m[1]);
  edge[n] = 1.5 * bin_m[n - 1] - 0.5 * bin_m[n - 2];
  edge_m_.assign(edge.begin(), edge.end());

  steps_per_m_ = static_cast<float>(1 / kTableStep);
  const int num_steps = static_cast<int>((edge[n] - edge[0]) / kTableStep) + 2;
  for (int step = 0, bin = 0; step < num_steps; ++step) {
    while (bin + 1 < size() && edge_m_[bin + 1] <= edge[0] + step * kTableStep) ++bin;
    bin_of_step_.push_back(bin);
  }

  for (size_t i = 0; i < n; ++i) {
    const double width = edge[i + 1] - edge[i];
    const double sigma = std::hypot(error.Sigma(bin_m[i]), width / std::sqrt(12.0));
    Spread spread;
    double below = 0;
    for (size_t j = 0; j < n; ++j) {
      // The first and last bin take the tails, so that no mass is lost.
      const double above = j + 1 == n ? 1 : NormalCdf((edge[j + 1] - bin_m[i]) / sigma);
      const double mass = above - below;
      below = above;
      if (mass < 1e-6 && spread.mass.empty()) {
        spread.first = static_cast<int>(j) + 1;
        continue;
      }
      spread.mass.push_back(static_cast<float>(mass));
      if (above > 1 - 1e-6) break;
    }
    spread_.push_back(std::move(spread));
  }
}

int RangeBins::BinAt(float r_m) const {
  const auto step = static_cast<size_t>((r_m - edge_m_.front()) * steps_per_m_);
  int bin = bin_of_step_[std::min(step, bin_of_step_.size() - 1)];
  while (bin + 1 < size() && r_m >= edge_m(bin + 1)) ++bin;
  return bin;
}

void RangeBins::BlurredCdf(const std::vector<float>& probability, float* cdf) const {
  std::fill(cdf, cdf + size() + 1, 0.0f);
  for (size_t i = 0; i < spread_.size(); ++i) {
    const float p = probability[i];
    if (p < 1e-7f) continue;
    float* to = cdf + 1 + spread_[i].first;
    for (size_t k = 0; k < spread_[i].mass.size(); ++k) to[k] += p * spread_[i].mass[k];
  }
  for (int i = 0; i < size(); ++i) cdf[i + 1] += cdf[i];
  const float total = cdf[size()];
  ENFILADE_CHECK_MSG(total > 0, "a wall distribution without mass");
  for (int i = 0; i <= size(); ++i) cdf[i] /= total;
}

float RangeBins::Evaluate(const float* at_edges, float r_m) const {
  if (r_m <= edge_m_.front()) return at_edges[0];
  if (r_m >= edge_m_.back()) return at_edges[size()];
  const int bin = BinAt(r_m);
  const float t = (r_m - edge_m(bin)) / (edge_m(bin + 1) - edge_m(bin));
  return at_edges[bin] + t * (at_edges[bin + 1] - at_edges[bin]);
}

PolarView::PolarView(const RangeBins& bins, std::vector<const WallSample*> columns)
    : bins_(&bins), view_idx_(columns.at(0)->view_idx), origin_(columns[0]->origin) {
  const auto azimuth = [](const WallSample* s) {
    return std::atan2(s->direction.y(), s->direction.x());
  };
  std::stable_sort(columns.begin(), columns.end(), [&](const WallSample* a, const WallSample* b) {
    return azimuth(a) < azimuth(b);
  });
  const auto stride = static_cast<size_t>(bins.size() + 1);
  cdf_.resize(columns.size() * stride);
  for (size_t i = 0; i < columns.size(); ++i) {
    const WallSample& sample = *columns[i];
    float* cdf = cdf_.data() + i * stride;
    bins.BlurredCdf(sample.wall_probability, cdf);
    const auto mode = static_cast<int>(
        std::max_element(sample.wall_probability.begin(), sample.wall_probability.end()) -
        sample.wall_probability.begin());
    const float mode_m = 0.5f * (bins.edge_m(mode) + bins.edge_m(mode + 1));
    const float width = bins.edge_m(mode + 1) - bins.edge_m(mode);
    Column column{};
    column.azimuth_rad = static_cast<float>(azimuth(&sample));
    column.half_spread_rad = static_cast<float>(0.5 * sample.spread_rad);
    // wall_m may be finer than the bins; one that disagrees with their mode is another hypothesis.
    const auto wall_m = static_cast<float>(sample.wall_m);
    column.mode_m = std::abs(wall_m - mode_m) <= width ? wall_m : mode_m;
    column.obstacle_m = static_cast<float>(sample.obstacle_m);
    column.confidence = static_cast<float>(sample.confidence);
    const auto* first = std::upper_bound(cdf, cdf + stride, kNegligible) - 1;
    const auto* last = std::lower_bound(cdf, cdf + stride - 1, 1 - kNegligible);
    column.clear_m = bins.edge_m(static_cast<int>(first - cdf));
    column.end_m = bins.edge_m(static_cast<int>(last - cdf));
    columns_.push_back(column);
  }
  const size_t num_steps = columns_.size() * kAzimuthStepsPerColumn;
  for (size_t step = 0, c = 0; step < num_steps; ++step) {
    const double start = 2 * kPi * static_cast<double>(step) / static_cast<double>(num_steps) - kPi;
    while (c < columns_.size() && columns_[c].azimuth_rad < start) ++c;
    first_at_step_.push_back(static_cast<int>(c));
  }
}

Eigen::Vector2d PolarView::Direction(int column) const {
  const double azimuth = columns_[column].azimuth_rad;
  return {std::cos(azimuth), std::sin(azimuth)};
}

bool PolarView::FindNeighbours(float azimuth_rad, Neighbours& n) const {
  constexpr auto kTwoPi = static_cast<float>(2 * kPi);
  const int count = static_cast<int>(columns_.size());
  const float steps_per_rad = static_cast<float>(first_at_step_.size()) / kTwoPi;
  const float position = (azimuth_rad + static_cast<float>(kPi)) * steps_per_rad;
  const auto step =
      std::min(static_cast<size_t>(std::max(position, 0.0f)), first_at_step_.size() - 1);
  int after = first_at_step_[step];
  // The table may be one column late through rounding of the azimuth.
  while (after > 0 && columns_[after - 1].azimuth_rad >= azimuth_rad) --after;
  while (after < count && columns_[after].azimuth_rad < azimuth_rad) ++after;
  const int b = after < count ? after : 0, a = after > 0 ? after - 1 : count - 1;
  const Column& left = columns_[a];
  const Column& right = columns_[b];
  float to_left = azimuth_rad - left.azimuth_rad, to_right = right.azimuth_rad - azimuth_rad;
  if (to_left < 0) to_left += kTwoPi;
  if (to_right < 0) to_right += kTwoPi;

  const float gap = to_left + to_right;
  const bool is_adjacent =
      count > 1 && gap <= 1.5f * (left.half_spread_rad + right.half_spread_rad);
  if (is_adjacent) {
    const float near = std::min(left.mode_m, right.mode_m),
                far = std::max(left.mode_m, right.mode_m);
    if ((far - near) * kMinGrazingTangent <= near * gap) {
      const float t = gap > 0 ? to_left / gap : 0;
      // The surface's 1/r between the columns, relative to that of each.
      const float ratio = left.mode_m / right.mode_m;
      n = {{a, b}, {1 - t, t}, {(1 - t) + t * ratio, (1 - t) / ratio + t}};
      return true;
    }
  }
  const bool is_left = to_left <= to_right;
  const Column& nearest = is_left ? left : right;
  if (!is_adjacent && std::min(to_left, to_right) > nearest.half_spread_rad) return false;
  n = {{is_left ? a : b, is_left ? a : b}, {1, 0}, {1, 1}};
  return true;
}

std::optional<PolarReading> PolarView::Read(const Eigen::Vector2f& offset, float r_m,
                                            float half_width_m, float blocked_depth_m) const {
  Neighbours n;
  if (!FindNeighbours(std::atan2(offset.y(), offset.x()), n)) return std::nullopt;
  const float blocked_m = r_m - blocked_depth_m, near_m = r_m - half_width_m,
              far_m = r_m + half_width_m;
  bool is_behind = true, is_before = true;
  for (int k = 0; k < 2; ++k) {
    is_behind =
        is_behind && std::min(blocked_m, near_m) * n.stretch[k] >= columns_[n.column[k]].end_m;
    is_before = is_before && far_m * n.stretch[k] <= columns_[n.column[k]].clear_m;
  }
  if (is_behind) return std::nullopt;
  PolarReading reading;
  reading.obstacle_m = std::min(columns_[n.column[0]].obstacle_m, columns_[n.column[1]].obstacle_m);
  reading.trust = n.weight[0] * columns_[n.column[0]].confidence +
                  n.weight[1] * columns_[n.column[1]].confidence;
  if (!trust_.empty()) {
    reading.trust *= n.weight[0] * bins_->Evaluate(RowOf(trust_, n.column[0]), r_m) +
                     n.weight[1] * bins_->Evaluate(RowOf(trust_, n.column[1]), r_m);
  }
  if (is_before) return reading;
  for (int k = 0; k < 2; ++k) {
    if (n.weight[k] == 0) continue;
    const float w = n.weight[k];
    const float* cdf = RowOf(cdf_, n.column[k]);
    reading.cdf_near += w * bins_->Evaluate(cdf, near_m * n.stretch[k]);
    reading.cdf += w * bins_->Evaluate(cdf, r_m * n.stretch[k]);
    reading.cdf_far += w * bins_->Evaluate(cdf, far_m * n.stretch[k]);
    reading.cdf_blocked += w * bins_->Evaluate(cdf, blocked_m * n.stretch[k]);
  }
  return reading;
}

std::vector<PolarView> MakePolarViews(const WallSampleSet& samples, const RangeBins& bins,
                                      RunContext& context) {
  std::map<int, std::vector<const WallSample*>> columns_of_view;
  for (const WallSample& sample : samples.samples) {
    if (sample.wall_probability.empty()) continue;
    ENFILADE_CHECK(sample.wall_probability.size() == samples.bin_m.size());
    ENFILADE_CHECK(sample.origin.allFinite() && std::abs(sample.direction.norm() - 1) < 1e-6);
    ENFILADE_CHECK(std::isfinite(sample.wall_m) && std::isfinite(sample.obstacle_m) &&
                   sample.spread_rad > 0);
    for (float p : sample.wall_probability) ENFILADE_CHECK(std::isfinite(p) && p >= 0);
    std::vector<const WallSample*>& columns = columns_of_view[sample.view_idx];
    ENFILADE_CHECK(columns.empty() || (columns[0]->origin - sample.origin).norm() < 1e-6);
    columns.push_back(&sample);
  }
  std::vector<const std::vector<const WallSample*>*> groups;
  for (const auto& [view_idx, columns] : columns_of_view) groups.push_back(&columns);
  std::vector<std::optional<PolarView>> built(groups.size());
  ParallelFor(context, "", static_cast<int64_t>(groups.size()),
              [&](int64_t i) { built[i].emplace(bins, *groups[i]); });
  std::vector<PolarView> views;
  views.reserve(built.size());
  for (std::optional<PolarView>& view : built) views.push_back(std::move(*view));
  return views;
}

}  // namespace enfilade
