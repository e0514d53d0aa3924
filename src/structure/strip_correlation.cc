// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/strip_correlation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "enfilade/geometry/angles.h"
#include "enfilade/image/sampling.h"
#include "enfilade/structure/types.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr int kHeights = StripTable::kNumHeights;
constexpr int kHalfLines = 3;
constexpr int kNumLines = 2 * kHalfLines + 1;
// The correlation changes slowly with distance: it is computed at every so many bins.
constexpr int kBinStep = 2;

int AzimuthIndex(const Vector2d& ray) { return ColumnOf(ray, StripTable::kNumAzimuths); }

// The upright lines of a strip on its wall plane.
struct Strip {
  std::array<Vector2d, kNumLines> foot;          // in the frame
  std::array<const uint8_t*, kNumLines> line{};  // grey levels in its own panorama
  bool is_valid = true;
};

// Sums over the lines of a strip, one for each height, with t = −kHalfLines … kHalfLines along the
// wall. Correlating what varies along the wall at one height leaves out the change from floor to
// wall to ceiling, which any hypothesis would share. Its linear part counts only as far as it is
// stronger than shading: the slow shading of bare walls looks alike on any plane nearby.
struct Moments {
  static constexpr int kSumTT = kHalfLines * (kHalfLines + 1) * kNumLines / 3;

  std::array<int32_t, kHeights> sum_a{}, sum_b{}, sum_aa{}, sum_bb{}, sum_ab{}, sum_ta{}, sum_tb{};

  void Add(int t, const uint8_t* a, const uint8_t* b) {
    for (size_t i = 0; i < kHeights; ++i) {
      const int32_t x = a[i], y = b[i];
      sum_a[i] += x;
      sum_b[i] += y;
      sum_aa[i] += x * x;
      sum_bb[i] += y * y;
      sum_ab[i] += x * y;
      sum_ta[i] += t * x;
      sum_tb[i] += t * y;
    }
  }

  [[nodiscard]] double Correlation(const StripCorrelationOptions& options) const {
    int64_t aa = 0, bb = 0, ab = 0, sum_ta_ta = 0, sum_tb_tb = 0, sum_ta_tb = 0;
    for (size_t i = 0; i < kHeights; ++i) {
      aa += kNumLines * sum_aa[i] - sum_a[i] * sum_a[i];
      bb += kNumLines * sum_bb[i] - sum_b[i] * sum_b[i];
      ab += kNumLines * sum_ab[i] - sum_a[i] * sum_b[i];
      sum_ta_ta += sum_ta[i] * sum_ta[i];
      sum_tb_tb += sum_tb[i] * sum_tb[i];
      sum_ta_tb += sum_ta[i] * sum_tb[i];
    }
    // What a variance of 1 at every height adds up to.
    constexpr double kUnit = kHeights * kNumLines * kNumLines;
    constexpr double kTrend = static_cast<double>(kNumLines) / kSumTT;
    const double noise = kUnit * options.noise * options.noise;
    const double shading = kUnit * options.shading * options.shading;
    const double trend =
        kTrend * std::sqrt(static_cast<double>(sum_ta_ta) * static_cast<double>(sum_tb_tb));
    const double shading_share = shading * shading / (trend * trend + shading * shading + 1e-12);
    const auto without_shading = [&](int64_t all, int64_t sum_t_t) {
      return static_cast<double>(all) - shading_share * kTrend * static_cast<double>(sum_t_t);
    };
    return without_shading(ab, sum_ta_tb) / std::sqrt((without_shading(aa, sum_ta_ta) + noise) *
                                                          (without_shading(bb, sum_tb_tb) + noise) +
                                                      1e-12);
  }
};

class Correlator {
 public:
  Correlator(std::span<const StripTable> tables, int self, std::span<const int> others,
             std::span<const KnownDistances> known, const DistanceBins& bins,
             const StripCorrelationOptions& options)
      : tables_(tables),
        self_(tables[static_cast<size_t>(self)]),
        others_(others),
        known_(known),
        bins_(bins),
        options_(options) {}

  [[nodiscard]] float Score(double azimuth, int family, int bin) const {
    const double direction = WallDirection(family, azimuth);
    const Strip strip = MakeStrip(azimuth, direction, bins_.Distance(bin));
    if (!strip.is_valid) return 0;
    const Vector2d normal(-std::sin(direction), std::cos(direction));
    double sum = 0;
    int count = 0;
    for (const int other : others_) {
      if (count >= options_.max_views) break;
      const StripTable& table = tables_[static_cast<size_t>(other)];
      if (!WouldSee({strip.foot[kHalfLines], normal, self_.position()}, table.position(),
                    known_[static_cast<size_t>(other)], options_.max_view_distance_m))
        continue;
      double correlation = 0;
      if (!Compare(strip, table, &correlation)) continue;
      sum += correlation;
      ++count;
    }
    return count > 0 ? static_cast<float>(sum / count) : 0.0F;
  }

 private:
  [[nodiscard]] Strip MakeStrip(double azimuth, double direction, double distance) const {
    Strip strip;
    const double incidence = std::sin(azimuth - direction);
    for (int i = -kHalfLines; i <= kHalfLines; ++i) {
      const double a = azimuth + DegToRad(options_.half_width_deg) * i / kHalfLines;
      const double line_incidence = std::sin(a - direction);
      if (std::abs(line_incidence) < kMinIncidenceSin || line_incidence * incidence < 0)
        return {{}, {}, false};
      const double r = distance * incidence / line_incidence;
      const Vector2d ray = r * Vector2d(std::cos(a), std::sin(a));
      const double r_bin = bins_.Bin(r) + 0.5;
      if (r_bin < 0 || r_bin >= bins_.count) return {{}, {}, false};
      const size_t slot = static_cast<size_t>(i + kHalfLines);
      strip.foot[slot] = self_.position() + ray;
      strip.line[slot] = self_.line(AzimuthIndex(ray), static_cast<int>(r_bin));
    }
    return strip;
  }

  [[nodiscard]] bool Compare(const Strip& strip, const StripTable& table,
                             double* correlation) const {
    Moments moments;
    for (int i = 0; i < kNumLines; ++i) {
      const Vector2d ray = strip.foot[static_cast<size_t>(i)] - table.position();
      const double bin = bins_.Bin(ray.norm()) + 0.5;
      if (bin < 0 || bin >= bins_.count) return false;
      moments.Add(i - kHalfLines, strip.line[static_cast<size_t>(i)],
                  table.line(AzimuthIndex(ray), static_cast<int>(bin)));
    }
    *correlation = moments.Correlation(options_);
    return true;
  }

  std::span<const StripTable> tables_;
  const StripTable& self_;
  std::span<const int> others_;
  std::span<const KnownDistances> known_;
  const DistanceBins& bins_;
  const StripCorrelationOptions& options_;
};

// Linear interpolation between every kBinStep-th value.
void FillBetween(float* values, int count) {
  for (int b = 0; b < count; ++b) {
    const int before = b / kBinStep * kBinStep, after = before + kBinStep;
    if (b == before) continue;
    const float a = static_cast<float>(b - before) / kBinStep;
    values[b] = after < count ? (1 - a) * values[before] + a * values[after] : values[before];
  }
}

ImageF GreyAt(const LevelPanorama& panorama, int cols) {
  const int factor = std::max(1, panorama.cols() / cols);
  ImageF grey(panorama.rows() / factor, panorama.cols() / factor);
  for (int r = 0; r < grey.rows(); ++r) {
    for (int c = 0; c < grey.cols(); ++c) {
      float sum = 0;
      for (int y = 0; y < factor; ++y) {
        for (int x = 0; x < factor; ++x) {
          const uint8_t* p = &panorama.rgb(r * factor + y, c * factor + x);
          sum += 0.299F * p[0] + 0.587F * p[1] + 0.114F * p[2];
        }
      }
      grey(r, c) = sum / static_cast<float>(factor * factor);
    }
  }
  return grey;
}

}  // namespace

StripTable::StripTable(const LevelPanorama& panorama, double bottom_z, double top_z,
                       const DistanceBins& bins)
    : position_(panorama.position.head<2>()),
      num_bins_(bins.count),
      grey_(static_cast<size_t>(kNumAzimuths) * static_cast<size_t>(bins.count) * kNumHeights) {
  const ImageF grey = GreyAt(panorama, kNumAzimuths);
  std::vector<double> rows(static_cast<size_t>(bins.count) * kNumHeights);
  for (int b = 0; b < bins.count; ++b) {
    for (int i = 0; i < kNumHeights; ++i) {
      const double z =
          bottom_z + (top_z - bottom_z) * i / (kNumHeights - 1) - panorama.position.z();
      rows[static_cast<size_t>(b * kNumHeights + i)] =
          grey.rows() * (0.5 - std::atan(z / bins.Distance(b)) / kPi);
    }
  }
  for (int a = 0; a < kNumAzimuths; ++a) {
    const double x = (a + 0.5) * grey.cols() / kNumAzimuths;
    uint8_t* out = grey_.data() + static_cast<size_t>(a) * rows.size();
    for (size_t i = 0; i < rows.size(); ++i) {
      out[i] = static_cast<uint8_t>(SampleBilinearWrapped(grey, x, rows[i]) + 0.5F);
    }
  }
}

ColumnScores CorrelateStrips(std::span<const StripTable> tables, int self,
                             std::span<const int> others, std::span<const KnownDistances> known,
                             int num_columns, int column_step, std::span<const int> families,
                             const DistanceBins& bins, const StripCorrelationOptions& options) {
  ENFILADE_CHECK(known.size() == tables.size() && column_step >= 1);
  const Correlator correlator(tables, self, others, known, bins, options);
  ColumnScores scores;
  for (const int family : families) {
    ImageF score(num_columns, bins.count);
    for (int c = 0; c < num_columns; c += column_step) {
      const double azimuth =
          AzimuthOfColumn(c, num_columns) + (column_step - 1) * kPi / num_columns;
      for (int b = 0; b < bins.count; b += kBinStep)
        score(c, b) = correlator.Score(azimuth, family, b);
      FillBetween(score.row(c), bins.count);
      for (int i = c + 1; i < std::min(c + column_step, num_columns); ++i) {
        std::copy_n(score.row(c), bins.count, score.row(i));
      }
    }
    scores.family[static_cast<size_t>(family)] = std::move(score);
  }
  return scores;
}

}  // namespace enfilade
