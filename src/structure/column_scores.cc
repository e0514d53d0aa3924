// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/column_scores.h"

#include <algorithm>

#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

// Rows of the response that a bin of distance covers.
struct RowRange {
  double center;
  int first, last;  // whole rows strictly inside the bin; empty when first > last
};

std::vector<RowRange> RowsOfBins(int rows, double height_m, const DistanceBins& bins) {
  const auto row = [&](double bin) {
    return rows * (0.5 + std::atan(height_m / bins.Distance(bin)) / kPi) - 0.5;
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

}  // namespace

std::vector<double> DistanceBins::Centers() const {
  std::vector<double> centers;
  for (int b = 0; b < count; ++b) centers.push_back(Distance(b));
  return centers;
}

ColumnScores ScoreLine(const LineResponse& response, double height_m, const DistanceBins& bins) {
  ColumnScores scores;
  for (int f = 0; f < kNumFamilies; ++f) {
    const ImageU8& picture = response.family[static_cast<size_t>(f)];
    if (picture.empty()) continue;
    const std::vector<RowRange> ranges = RowsOfBins(picture.rows(), height_m, bins);
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

ColumnScores ScoreFloor(const LineResponse& response, double floor_m, double baseboard_m,
                        const DistanceBins& bins) {
  ColumnScores floor = ScoreLine(response, floor_m, bins);
  if (baseboard_m <= 0) return floor;
  ColumnScores mean;
  AddScores(floor, 0.5, mean);
  AddScores(ScoreLine(response, floor_m - baseboard_m, bins), 0.5, mean);
  return mean;
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
