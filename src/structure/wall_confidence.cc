// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/wall_confidence.h"

#include <algorithm>
#include <cmath>

#include "enfilade/base/check.h"
#include "enfilade/structure/types.h"

namespace enfilade {
namespace {

// Planes whose offsets differ by more than so many bins are different walls.
constexpr double kSameWallBins = 1.5;

// Whether column c continues the wall of the column before it.
bool ContinuesWall(const WallPath& path, int c, const DistanceBins& bins) {
  const int num_columns = static_cast<int>(path.wall_m.size());
  const auto offset = [&](int column) {
    const double azimuth = AzimuthOfColumn(column, num_columns);
    const size_t i = static_cast<size_t>(column);
    return path.wall_m[i] * std::abs(std::sin(azimuth - WallDirection(path.family[i], azimuth)));
  };
  const int before = (c + num_columns - 1) % num_columns;
  return path.family[static_cast<size_t>(c)] == path.family[static_cast<size_t>(before)] &&
         std::abs(std::log(offset(c) / offset(before))) <= kSameWallBins * bins.log_step;
}

float ResponseAt(const WallPath& path, const ColumnScores& lines, int c, const DistanceBins& bins,
                 double clear_response) {
  const size_t i = static_cast<size_t>(c);
  const ImageF& score = lines.family[static_cast<size_t>(path.family[i])];
  if (score.empty()) return static_cast<float>(clear_response);
  const int bin = static_cast<int>(std::lround(bins.Bin(path.wall_m[i])));
  return score(c, std::clamp(bin, 0, bins.count - 1));
}

}  // namespace

std::vector<float> WallConfidence(const WallPath& path, const ColumnScores& lines,
                                  std::span<const uint8_t> is_seen, const DistanceBins& bins,
                                  double clear_response) {
  ENFILADE_CHECK(is_seen.size() == path.wall_m.size());
  const int num_columns = static_cast<int>(path.wall_m.size());
  std::vector<float> confidence(path.wall_m.size(), 1.0F);
  if (clear_response <= 0) return confidence;
  int start = 0;  // the first column of a wall, so that none is cut by the seam
  while (start < num_columns && ContinuesWall(path, start, bins)) ++start;
  const auto column = [&](int k) { return (start + k) % num_columns; };
  for (int begin = 0; begin < num_columns;) {
    double sum = 0;
    int num_seen = 0, end = begin;
    do {
      if (is_seen[static_cast<size_t>(column(end))] != 0) {
        sum += ResponseAt(path, lines, column(end), bins, clear_response);
        ++num_seen;
      }
    } while (++end < num_columns && ContinuesWall(path, column(end), bins));
    const double explained = sum / (std::max(1, num_seen) * clear_response);
    for (; begin < end; ++begin) {
      confidence[static_cast<size_t>(column(begin))] =
          static_cast<float>(std::clamp(explained, 0.0, 1.0));
    }
  }
  // One path explains the whole panorama: where much of it fails, the rest fits by chance.
  double sum_seen = 0;
  int num_seen = 0;
  for (size_t c = 0; c < confidence.size(); ++c) {
    if (is_seen[c] == 0) continue;
    sum_seen += confidence[c];
    ++num_seen;
  }
  const auto mean = static_cast<float>(sum_seen / std::max(1, num_seen));
  for (float& value : confidence) value *= mean;
  return confidence;
}

}  // namespace enfilade
