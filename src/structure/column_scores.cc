// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/column_scores.h"

#include <algorithm>
#include <cmath>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/structure/types.h"

namespace enfilade {
namespace {

// How far a cornice stands out for its height: mouldings are set at 38° (0.78) or 45° (1).
constexpr double kCorniceDepth = 0.8;
// Families 0 and 1, walls along the home's axes.
constexpr int kNumAxisFamilies = 2;
// What stands before a wall is no nearer than this.
constexpr double kNearest_m = 0.05;

// Rows of the response that a bin of distance covers.
struct RowRange {
  double center;
  int first, last;  // whole rows strictly inside the bin; empty when first > last
};

std::vector<RowRange> RowsOfBins(int rows, double height_m, double before_m,
                                 const DistanceBins& bins) {
  const auto row = [&](double bin) {
    const double distance_m = std::max(kNearest_m, bins.Distance(bin) - before_m);
    return rows * (0.5 + std::atan(height_m / distance_m) / kPi) - 0.5;
  };
  std::vector<RowRange> ranges;
  for (int b = 0; b < bins.count; ++b) {
    const double a = row(b - 0.5), z = row(b + 0.5);
    ranges.push_back({std::clamp(row(b), 0.0, rows - 1.001),
                      std::max(0, static_cast<int>(std::ceil(std::min(a, z)))),
                      std::min(rows - 1, static_cast<int>(std::floor(std::max(a, z))))});
  }
  return ranges;
}

// Near bins span several rows: the strongest counts. Far ones share a row: interpolated.
float ResponseAt(const ImageU8& response, const RowRange& range, int column) {
  const int r0 = static_cast<int>(range.center);
  const float a = static_cast<float>(range.center - r0);
  float best = (1 - a) * response(r0, column) + a * response(r0 + 1, column);
  for (int r = range.first; r <= range.last; ++r)
    best = std::max(best, static_cast<float>(response(r, column)));
  return best / 255.0F;
}

struct BinRange {
  int first, last;
};

// A wall's own line reaches so far behind it: the foot of a baseboard, blur.
constexpr double kOwnShare = 0.1, kOwn_m = 0.05;

// Bins that lie behind a wall, farther than its own line reaches.
std::vector<BinRange> BinsBehind(const DistanceBins& bins, double reach_m) {
  std::vector<BinRange> ranges;
  for (int b = 0; b < bins.count; ++b) {
    const double wall_m = bins.Distance(b);
    ranges.push_back(
        {static_cast<int>(std::ceil(bins.Bin((1 + kOwnShare) * wall_m + kOwn_m))),
         std::min(bins.count - 1, static_cast<int>(std::floor(bins.Bin(wall_m + reach_m))))});
  }
  return ranges;
}

// Bins of a wall's own line and of what lies up to reach_m before it.
std::vector<BinRange> BinsUpTo(const DistanceBins& bins, double reach_m) {
  std::vector<BinRange> ranges;
  for (int b = 0; b < bins.count; ++b) {
    const double wall_m = bins.Distance(b);
    const double own_m = kOwnShare * wall_m + kOwn_m;
    ranges.push_back({bins.NearestBin(std::max(bins.min_m, wall_m - std::max(reach_m, own_m))),
                      bins.NearestBin(wall_m + own_m)});
  }
  return ranges;
}

float Strongest(const std::vector<float>& row, const BinRange& range) {
  if (range.first > range.last) return 0;
  return *std::max_element(row.begin() + range.first, row.begin() + range.last + 1);
}

// The strongest score of some families in one column.
std::vector<float> StrongestOf(const ColumnScores& scores, int num_families, int column,
                               int num_bins) {
  std::vector<float> strongest(static_cast<size_t>(num_bins), 0);
  for (int f = 0; f < num_families; ++f) {
    const ImageF& score = scores.family[static_cast<size_t>(f)];
    if (score.empty()) continue;
    for (size_t b = 0; b < strongest.size(); ++b)
      strongest[b] = std::max(strongest[b], score(column, static_cast<int>(b)));
  }
  return strongest;
}

// Of the elevation below the horizon at which each bin's floor is seen.
struct Elevation {
  double sine, cosine;
};

std::vector<Elevation> ElevationsOfFloor(double floor_m, const DistanceBins& bins) {
  std::vector<Elevation> elevations;
  for (int b = 0; b < bins.count; ++b) {
    const double elevation = std::atan(floor_m / bins.Distance(b));
    elevations.push_back({std::sin(elevation), std::cos(elevation)});
  }
  return elevations;
}

// For each bin of a column, how much more clearly a line on the floor that runs along family 0 or 1
// shows there than one along `family`. Those that look upright may be upright lines of a wall.
std::vector<float> CrossingLines(const ColumnScores& floor, int family, int column,
                                 const std::vector<Elevation>& elevations) {
  constexpr double kUprightSine = 0.3, kSurelyNotSine = 0.6;
  const ImageF& own = floor.family[static_cast<size_t>(family)];
  const double azimuth = AzimuthOfColumn(column, own.rows());
  std::vector<float> crossing(elevations.size());
  for (const int other : {0, 1}) {
    const ImageF& across = floor.family[static_cast<size_t>(other)];
    if (other == family || across.empty()) continue;
    const double off = WallDirection(other, azimuth) - azimuth;
    const double sin_off = std::sin(off), cos_off = std::cos(off);
    for (int b = 0; b < own.cols(); ++b) {
      const Elevation& elevation = elevations[static_cast<size_t>(b)];
      // Of the angle between the line and the upright in the picture.
      const double x = sin_off / elevation.cosine, y = elevation.sine * cos_off;
      const double sine = std::abs(x) / std::hypot(x, y);
      const double weight =
          std::clamp((sine - kUprightSine) / (kSurelyNotSine - kUprightSine), 0.0, 1.0);
      float& strongest = crossing[static_cast<size_t>(b)];
      strongest =
          std::max(strongest, static_cast<float>(weight) * (across(column, b) - own(column, b)));
    }
  }
  return crossing;
}

// Scores of the same shape; fill(family, column, row) writes one row of them.
template <typename Fill>
ColumnScores MapColumns(const ColumnScores& scores, const Fill& fill) {
  ColumnScores mapped;
  for (int f = 0; f < kNumFamilies; ++f) {
    const ImageF& from = scores.family[static_cast<size_t>(f)];
    if (from.empty()) continue;
    ImageF& to = mapped.family[static_cast<size_t>(f)];
    to = ImageF(from.rows(), from.cols());
    for (int c = 0; c < from.rows(); ++c) fill(f, c, to.row(c));
  }
  return mapped;
}

}  // namespace

std::vector<double> DistanceBins::Centers() const {
  std::vector<double> centers;
  for (int b = 0; b < count; ++b) centers.push_back(Distance(b));
  return centers;
}

ColumnScores ScoreLine(const LineResponse& response, double height_m, const DistanceBins& bins,
                       double before_m) {
  ColumnScores scores;
  for (int f = 0; f < kNumFamilies; ++f) {
    const ImageU8& picture = response.family[static_cast<size_t>(f)];
    if (picture.empty()) continue;
    const std::vector<RowRange> ranges = RowsOfBins(picture.rows(), height_m, before_m, bins);
    ImageF score(picture.cols(), bins.count);
    for (int c = 0; c < picture.cols(); ++c) {
      for (int b = 0; b < bins.count; ++b) {
        score(c, b) = ResponseAt(picture, ranges[static_cast<size_t>(b)], c);
      }
    }
    scores.family[static_cast<size_t>(f)] = std::move(score);
  }
  return scores;
}

ColumnScores ScoreFloor(const LineResponse& response, double floor_m, const Baseboard& baseboard,
                        const DistanceBins& bins) {
  ColumnScores floor = ScoreLine(response, floor_m, bins);
  if (baseboard.height_m <= 0) return floor;
  ColumnScores both;
  AddScores(floor, 1 - baseboard.share, both);
  AddScores(ScoreLine(response, floor_m - baseboard.height_m, bins), baseboard.share, both);
  return both;
}

ColumnScores ScoreCeiling(const LineResponse& response, double above_m, double cornice_m,
                          const DistanceBins& bins) {
  if (cornice_m <= 0) return ScoreLine(response, -above_m, bins);
  ColumnScores both;
  AddScores(ScoreLine(response, -above_m, bins, kCorniceDepth * cornice_m), 0.5, both);
  AddScores(ScoreLine(response, cornice_m - above_m, bins), 0.5, both);
  return both;
}

ColumnScores WidenScores(const ColumnScores& scores, int reach) {
  if (reach <= 0) return scores;
  return MapColumns(scores, [&](int f, int c, float* to) {
    const ImageF& from = scores.family[static_cast<size_t>(f)];
    const float* row = from.row(c);
    for (int b = 0; b < from.cols(); ++b) {
      to[b] = *std::max_element(row + std::max(0, b - reach),
                                row + std::min(from.cols(), b + reach + 1));
    }
  });
}

ColumnScores StopFloorLines(const ColumnScores& floor, double floor_m, const DistanceBins& bins,
                            const FloorEndOptions& options) {
  const std::vector<BinRange> behind = BinsBehind(bins, options.reach_m);
  const std::vector<Elevation> elevations = ElevationsOfFloor(floor_m, bins);
  return MapColumns(floor, [&](int f, int c, float* to) {
    const float* own = floor.family[static_cast<size_t>(f)].row(c);
    const std::vector<float> crossing = CrossingLines(floor, f, c, elevations);
    for (int b = 0; b < bins.count; ++b) {
      const float strongest = Strongest(crossing, behind[static_cast<size_t>(b)]);
      to[b] = own[b] * (1 - static_cast<float>(options.weight) * strongest);
    }
  });
}

ImageF CeilingEnds(const ColumnScores& ceiling, const DistanceBins& bins,
                   const CeilingEndOptions& options) {
  const std::vector<BinRange> behind = BinsBehind(bins, options.reach_m);
  const std::vector<BinRange> up_to = BinsUpTo(bins, options.before_m);
  ImageF share;
  for (const ImageF& score : ceiling.family) {
    if (share.empty() && !score.empty()) share = ImageF(score.rows(), score.cols());
  }
  for (int c = 0; c < share.rows(); ++c) {
    const std::vector<float> along_axes = StrongestOf(ceiling, kNumAxisFamilies, c, bins.count);
    const std::vector<float> any = StrongestOf(ceiling, kNumFamilies, c, bins.count);
    for (int b = 0; b < bins.count; ++b) {
      const float seen_on = Strongest(along_axes, behind[static_cast<size_t>(b)]) -
                            Strongest(any, up_to[static_cast<size_t>(b)]);
      share(c, b) = 1 - static_cast<float>(options.weight) * std::max(0.0F, seen_on);
    }
  }
  return share;
}

ColumnScores AllowObstacles(const ColumnScores& floor, const DistanceBins& bins,
                            const ObstacleOptions& options) {
  ColumnScores allowed = floor;
  for (int f = 0; f < kNumFamilies; ++f) {
    const ImageF& source = floor.family[static_cast<size_t>(f)];
    if (source.empty()) continue;
    ImageF& target = allowed.family[static_cast<size_t>(f)];
    for (int b = 0; b < bins.count; ++b) {
      const double wall_m = bins.Distance(b);
      if (wall_m - options.min_gap_m <= bins.min_m) continue;
      const int last = static_cast<int>(std::floor(bins.Bin(wall_m - options.min_gap_m)));
      const double nearest_m = std::max(bins.min_m, wall_m - options.max_gap_m);
      const int first = std::max(0, static_cast<int>(std::ceil(bins.Bin(nearest_m))));
      for (int c = 0; c < source.rows(); ++c) {
        float best = 0;
        for (int i = first; i <= last; ++i) best = std::max(best, source(c, i));
        target(c, b) = std::max(target(c, b), best - static_cast<float>(options.cost));
      }
    }
  }
  return allowed;
}

void ScaleScores(const ImageF& share, ColumnScores& scores) {
  for (ImageF& score : scores.family) {
    if (score.empty()) continue;
    ENFILADE_CHECK(score.rows() == share.rows() && score.cols() == share.cols());
    for (size_t i = 0; i < score.data().size(); ++i) {
      if (score.data()[i] > 0) score.data()[i] *= share.data()[i];
    }
  }
}

void AddScores(const ColumnScores& source, double weight, ColumnScores& target) {
  for (size_t f = 0; f < source.family.size(); ++f) {
    const ImageF& from = source.family[f];
    if (from.empty()) continue;
    ImageF& to = target.family[f];
    if (to.empty()) to = ImageF(from.rows(), from.cols());
    ENFILADE_CHECK(to.rows() == from.rows() && to.cols() == from.cols());
    for (size_t i = 0; i < from.data().size(); ++i) {
      to.data()[i] += static_cast<float>(weight) * from.data()[i];
    }
  }
}

}  // namespace enfilade
