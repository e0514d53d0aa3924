// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/plane_viterbi.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/structure/types.h"

namespace enfilade {
namespace {

constexpr float kImpossible = -1e9F;
// Planes seen at a smaller angle than this say nothing.
constexpr double kMinIncidenceCos = 0.04;

// Flat arrays over (family slot, bin).
using Messages = std::vector<float>;

class Trellis {
 public:
  Trellis(const ColumnScores& scores, const DistanceBins& bins, const PlaneViterbiOptions& options)
      : scores_(scores), bins_(bins), options_(options) {
    for (int f = 0; f < kNumFamilies; ++f) {
      const ImageF& picture = scores.family[static_cast<size_t>(f)];
      if (picture.empty()) continue;
      ENFILADE_CHECK(picture.cols() == bins.count);
      ENFILADE_CHECK(families_.empty() || picture.rows() == num_columns_);
      families_.push_back(f);
      num_columns_ = picture.rows();
    }
    ENFILADE_CHECK(!families_.empty() && num_columns_ >= 4);
    column_deg_ = 360.0 / num_columns_;
    ComputeEmissions();
  }

  [[nodiscard]] int num_columns() const { return num_columns_; }
  [[nodiscard]] int num_states() const { return num_slots() * bins_.count; }
  [[nodiscard]] int num_bins() const { return bins_.count; }
  [[nodiscard]] int num_slots() const { return static_cast<int>(families_.size()); }
  [[nodiscard]] int family(int state) const {
    return families_[static_cast<size_t>(state / bins_.count)];
  }
  [[nodiscard]] const float* emission(int column) const {
    return emissions_.data() + static_cast<size_t>(column) * static_cast<size_t>(num_states());
  }

  // Continuous bin of the distance at which a state's plane is met at an azimuth.
  [[nodiscard]] double DistanceBin(int state, double azimuth) const {
    return state % bins_.count + Shift(family(state), azimuth);
  }
  [[nodiscard]] double ColumnAzimuth(int column) const {
    return AzimuthOfColumn(column, num_columns_);
  }

  // out[s] = emission(to)[s] + max over predecessors. `boundary` is the azimuth between the
  // columns; the transition costs are symmetric, so the same step serves both directions.
  void Step(const Messages& in, double boundary, int to, Messages& out) const {
    const int count = bins_.count;
    const float jump =
        *std::max_element(in.begin(), in.end()) - static_cast<float>(options_.jump_cost_deg);
    const int stride = count + 2;
    Messages widened(static_cast<size_t>(num_slots() * stride));
    for (int g = 0; g < num_slots(); ++g) Widen(in.data() + g * count, widened.data() + g * stride);
    const float* e = emission(to);
    for (int f = 0; f < num_slots(); ++f) {
      const size_t base = static_cast<size_t>(f * count);
      float* o = out.data() + base;
      const float* same = in.data() + base;
      for (int k = 0; k < count; ++k) o[k] = std::max(same[k], jump);
      if (families_[static_cast<size_t>(f)] == kFrontalFamily) StepFree(same, o);
      for (int g = 0; g < num_slots(); ++g) {
        if (g == f) continue;
        const int delta = CornerDelta(f, g, boundary);
        const int first = std::max(0, -delta - 1), last = std::min(count, count - delta + 1);
        const float* w = widened.data() + g * stride + delta + 1;
        const float corner = static_cast<float>(options_.corner_cost_deg);
        for (int k = first; k < last; ++k) o[k] = std::max(o[k], w[k] - corner);
      }
      for (int k = 0; k < count; ++k)
        o[k] = std::max(o[k] + e[base + static_cast<size_t>(k)], kImpossible);
    }
  }

  // The predecessor of `state` in column `to` that attains the maximum in Step.
  [[nodiscard]] int Predecessor(const Messages& in, double boundary, int state) const {
    const int count = bins_.count;
    const int f = state / count, k = state % count;
    int best = state;
    float best_value = in[static_cast<size_t>(state)];
    const auto offer = [&](int from, double cost) {
      const float value = in[static_cast<size_t>(from)] - static_cast<float>(cost);
      if (value > best_value) {
        best_value = value;
        best = from;
      }
    };
    if (family(state) == kFrontalFamily) {
      if (k > 0) offer(state - 1, options_.frontal_step_cost);
      if (k + 1 < count) offer(state + 1, options_.frontal_step_cost);
    }
    for (int g = 0; g < num_slots(); ++g) {
      if (g == f) continue;
      const int center = k + CornerDelta(f, g, boundary);
      for (int i = std::max(0, center - 1); i <= std::min(count - 1, center + 1); ++i) {
        offer(g * count + i, options_.corner_cost_deg);
      }
    }
    const auto top = std::max_element(in.begin(), in.end());
    offer(static_cast<int>(top - in.begin()), options_.jump_cost_deg);
    return best;
  }

 private:
  // log(1/|cos|) of the angle to the plane's normal, in bins; huge when the plane is seen edge on.
  [[nodiscard]] double Shift(int family, double azimuth) const {
    if (family == kFrontalFamily) return 0;
    const double incidence = std::abs(std::sin(azimuth - WallDirection(family, azimuth)));
    if (incidence < kMinIncidenceCos) return bins_.count;
    return -std::log(incidence) / bins_.log_step;
  }

  [[nodiscard]] int CornerDelta(int slot, int other_slot, double boundary) const {
    const int f = families_[static_cast<size_t>(slot)],
              g = families_[static_cast<size_t>(other_slot)];
    return static_cast<int>(std::lround(Shift(f, boundary) - Shift(g, boundary)));
  }

  [[nodiscard]] double FamilyCost(int family) const {
    if (family == kFrontalFamily) return options_.frontal_cost;
    return family >= 2 ? options_.diagonal_cost : 0.0;
  }

  void ComputeEmissions() {
    emissions_.assign(static_cast<size_t>(num_columns_) * static_cast<size_t>(num_states()),
                      kImpossible);
    for (int c = 0; c < num_columns_; ++c) {
      float* e = emissions_.data() + static_cast<size_t>(c) * static_cast<size_t>(num_states());
      for (const int f : families_) {
        const float* score = scores_.family[static_cast<size_t>(f)].row(c);
        const double shift = Shift(f, ColumnAzimuth(c));
        const float cost = static_cast<float>(FamilyCost(f));
        for (int k = 0; k < bins_.count; ++k, ++e) {
          const double bin = k + shift;
          const int b = static_cast<int>(bin);
          if (b + 1 >= bins_.count) continue;
          const float a = static_cast<float>(bin - b);
          *e = static_cast<float>(column_deg_) * ((1 - a) * score[b] + a * score[b + 1] - cost);
        }
      }
    }
  }

  // out[k + 1] = the best of in[k − 1 … k + 1], for k from −1 to the number of bins.
  void Widen(const float* in, float* out) const {
    const int count = bins_.count;
    out[0] = in[0];
    for (int k = 0; k < count; ++k) {
      out[k + 1] =
          std::max(in[k], std::max(in[std::max(0, k - 1)], in[std::min(count - 1, k + 1)]));
    }
    out[count + 1] = in[count - 1];
  }

  void StepFree(const float* in, float* out) const {
    const float cost = static_cast<float>(options_.frontal_step_cost);
    for (int k = 1; k < bins_.count; ++k) out[k] = std::max(out[k], in[k - 1] - cost);
    for (int k = 0; k + 1 < bins_.count; ++k) out[k] = std::max(out[k], in[k + 1] - cost);
  }

  const ColumnScores& scores_;
  const DistanceBins& bins_;
  const PlaneViterbiOptions& options_;
  std::vector<int> families_;
  int num_columns_ = 0;
  double column_deg_ = 0;
  std::vector<float> emissions_;
};

// Messages of one lap over the columns start, start + direction, …; starts from `first` (which
// already holds the emission of the start column). The last step returns to the start column.
std::vector<Messages> RunLap(const Trellis& trellis, int start, int direction, Messages first) {
  const int n = trellis.num_columns();
  std::vector<Messages> lap;
  lap.reserve(static_cast<size_t>(n) + 1);
  lap.push_back(std::move(first));
  for (int i = 1; i <= n; ++i) {
    const int from = ((start + direction * (i - 1)) % n + n) % n;
    const int to = ((start + direction * i) % n + n) % n;
    const double boundary = trellis.ColumnAzimuth(from) + direction * kPi / n;
    lap.emplace_back(lap.back().size());
    trellis.Step(lap[static_cast<size_t>(i) - 1], boundary, to, lap[static_cast<size_t>(i)]);
  }
  return lap;
}

// Two laps; those of the second, which have seen the whole circle, indexed by column.
std::vector<Messages> CircularMessages(const Trellis& trellis, int direction) {
  const float* e = trellis.emission(0);
  Messages first(e, e + trellis.num_states());
  first = std::move(RunLap(trellis, 0, direction, std::move(first)).back());
  std::vector<Messages> lap = RunLap(trellis, 0, direction, std::move(first));
  lap.pop_back();
  if (direction < 0) std::reverse(lap.begin() + 1, lap.end());
  return lap;
}

struct Anchor {
  int column = 0;
  int state = 0;
};

// The column whose best state in the forward messages stands out most from other distances.
Anchor MostCertain(const Trellis& trellis, const std::vector<Messages>& messages) {
  Anchor best;
  double best_margin = -1;
  for (int c = 0; c < trellis.num_columns(); ++c) {
    const Messages& m = messages[static_cast<size_t>(c)];
    const int top = static_cast<int>(std::max_element(m.begin(), m.end()) - m.begin());
    const double azimuth = trellis.ColumnAzimuth(c);
    const double top_bin = trellis.DistanceBin(top, azimuth);
    float second = kImpossible;
    for (int slot = 0; slot < trellis.num_slots(); ++slot) {
      const int first = slot * trellis.num_bins();
      const double offset = trellis.DistanceBin(first, azimuth) - top_bin;
      for (int k = 0; k < trellis.num_bins(); ++k) {
        if (std::abs(k + offset) > 3) second = std::max(second, m[static_cast<size_t>(first + k)]);
      }
    }
    const double margin = m[static_cast<size_t>(top)] - second;
    // Where nothing but the best distance is possible the margin says nothing.
    const bool has_rival = second > kImpossible / 2;
    if (c == 0 || (has_rival && margin > best_margin)) best = {c, top};
    if (has_rival) best_margin = std::max(best_margin, margin);
  }
  return best;
}

// The best closed path through the anchor: states in columns anchor.column … around.
std::vector<int> ClosedPath(const Trellis& trellis, const Anchor& anchor, double* score) {
  const int n = trellis.num_columns();
  Messages first(static_cast<size_t>(trellis.num_states()), kImpossible);
  first[static_cast<size_t>(anchor.state)] = 0;
  const std::vector<Messages> lap = RunLap(trellis, anchor.column, 1, std::move(first));
  *score = lap.back()[static_cast<size_t>(anchor.state)];
  std::vector<int> states(static_cast<size_t>(n));
  int state = anchor.state;
  for (int i = n; i > 0; --i) {
    states[static_cast<size_t>((anchor.column + i) % n)] = state;
    const int from = (anchor.column + i - 1) % n;
    state = trellis.Predecessor(lap[static_cast<size_t>(i) - 1],
                                trellis.ColumnAzimuth(from) + kPi / n, state);
  }
  return states;
}

// Offset of the plane within ± one bin at which the summed emissions of its columns peak
// (parabola).
double RefineOffset(const Trellis& trellis, const std::vector<int>& columns, int state,
                    int num_bins) {
  const int k = state % num_bins;
  if (k == 0 || k + 1 == num_bins) return k;
  double below = 0, at = 0, above = 0;
  for (const int c : columns) {
    const float* e = trellis.emission(c);
    if (e[state + 1] <= kImpossible || e[state - 1] <= kImpossible) continue;
    below += e[state - 1];
    at += e[state];
    above += e[state + 1];
  }
  const double curvature = below - 2 * at + above;
  if (curvature >= 0) return k;
  return k + std::clamp(0.5 * (below - above) / curvature, -0.5, 0.5);
}

void ReadPath(const Trellis& trellis, const DistanceBins& bins, const std::vector<int>& states,
              WallPath& path) {
  const int n = trellis.num_columns();
  path.family.resize(static_cast<size_t>(n));
  path.wall_m.resize(static_cast<size_t>(n));
  // Start at a change of state so that every wall is one run.
  int start = 0;
  while (start < n &&
         states[static_cast<size_t>(start)] == states[static_cast<size_t>((start + n - 1) % n)])
    ++start;
  start %= n;
  for (int i = 0; i < n;) {
    const int state = states[static_cast<size_t>((start + i) % n)];
    std::vector<int> columns;
    for (; i < n && states[static_cast<size_t>((start + i) % n)] == state; ++i)
      columns.push_back((start + i) % n);
    const double offset = RefineOffset(trellis, columns, state, bins.count) - state % bins.count;
    for (const int c : columns) {
      path.family[static_cast<size_t>(c)] = trellis.family(state);
      path.wall_m[static_cast<size_t>(c)] =
          bins.Distance(trellis.DistanceBin(state, trellis.ColumnAzimuth(c)) + offset);
    }
  }
}

ImageF LogLikelihood(const Trellis& trellis, const DistanceBins& bins,
                     const std::vector<Messages>& forward, const std::vector<Messages>& backward,
                     double temperature) {
  const int n = trellis.num_columns();
  ImageF result(n, bins.count, 1, -std::numeric_limits<float>::infinity());
  for (int c = 0; c < n; ++c) {
    float* row = result.row(c);
    const float* e = trellis.emission(c);
    for (int slot = 0; slot < trellis.num_slots(); ++slot) {
      const double shift = trellis.DistanceBin(slot * bins.count, trellis.ColumnAzimuth(c));
      for (int k = 0; k < bins.count; ++k) {
        const int bin = static_cast<int>(std::lround(k + shift));
        if (bin >= bins.count) break;
        const size_t s = static_cast<size_t>(slot * bins.count + k);
        if (e[s] <= kImpossible) continue;
        row[bin] = std::max(row[bin], forward[static_cast<size_t>(c)][s] +
                                          backward[static_cast<size_t>(c)][s] - e[s]);
      }
    }
    const float top = *std::max_element(row, row + bins.count);
    for (int b = 0; b < bins.count; ++b) row[b] = (row[b] - top) / static_cast<float>(temperature);
  }
  return result;
}

}  // namespace

WallPath FindWallPath(const ColumnScores& scores, const DistanceBins& bins,
                      const PlaneViterbiOptions& options, bool with_likelihood) {
  const Trellis trellis(scores, bins, options);
  const std::vector<Messages> forward = CircularMessages(trellis, 1);
  WallPath path;
  const Anchor anchor = MostCertain(trellis, forward);
  ReadPath(trellis, bins, ClosedPath(trellis, anchor, &path.score), path);
  if (with_likelihood) {
    path.log_likelihood = LogLikelihood(trellis, bins, forward, CircularMessages(trellis, -1),
                                        options.temperature_deg);
  }
  return path;
}

}  // namespace enfilade
