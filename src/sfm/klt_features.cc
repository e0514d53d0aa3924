// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/klt_features.h"

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr int kBlockRadius = kCornerSize_px / 2;
constexpr int kBandRows = 64;

struct Corner {
  float score = 0;
  int row = 0, col = 0;
};

// Smaller eigenvalues of the mean squared gradients, for the rows begin … end − 1 of the picture
// and columns −1 … cols: one more on each side for the comparison with neighbours.
ImageF CornerScores(const GrayLevel& level, int begin, int end) {
  constexpr int kTaps = kCornerSize_px;
  const int cols = level.cols + 2, wide = cols + 2 * kBlockRadius;
  const int border = GrayLevel::kBorder_px;
  ImageF scores(end - begin, cols), products(kTaps, 3 * wide);
  std::vector<float> sums(static_cast<size_t>(wide) * 3);
  for (int r = begin - kBlockRadius; r < end + kBlockRadius; ++r) {
    const float* middle = level.gray.row(r + border) + border - 1 - kBlockRadius;
    const float *above = middle - level.gray.cols(), *below = middle + level.gray.cols();
    float* xx = products.row(((r % kTaps) + kTaps) % kTaps);
    float *xy = xx + wide, *yy = xy + wide;
    for (int c = 0; c < wide; ++c) {
      const float gx = 0.5f * (middle[c + 1] - middle[c - 1]), gy = 0.5f * (below[c] - above[c]);
      xx[c] = gx * gx;
      xy[c] = gx * gy;
      yy[c] = gy * gy;
    }
    if (r < begin + kBlockRadius) continue;
    const float *p0 = products.row(0), *p1 = products.row(1), *p2 = products.row(2),
                *p3 = products.row(3), *p4 = products.row(4);
    for (int c = 0; c < 3 * wide; ++c)
      sums[static_cast<size_t>(c)] = p0[c] + p1[c] + p2[c] + p3[c] + p4[c];
    const float *sxx = sums.data(), *sxy = sxx + wide, *syy = sxy + wide;
    float* score = scores.row(r - kBlockRadius - begin);
    const auto sum5 = [](const float* s) { return s[0] + s[1] + s[2] + s[3] + s[4]; };
    for (int c = 0; c < cols; ++c) {
      const float a = sum5(sxx + c), b = sum5(sxy + c), d = sum5(syy + c);
      const float half_difference = 0.5f * (a - d);
      score[c] = (0.5f * (a + d) - std::sqrt(half_difference * half_difference + b * b)) *
                 (1.0f / kCornerArea);
    }
  }
  return scores;
}

// No neighbour is better, and none before it in the order of pixels is as good.
bool IsPeak(const ImageF& scores, int row, int col) {
  const float score = scores(row, col);
  for (int r = row - 1; r <= row + 1; ++r) {
    for (int c = col - 1; c <= col + 1; ++c) {
      const bool is_before = r < row || (r == row && c < col);
      const float other = scores(r, c);
      if (other > score || (is_before && other == score)) return false;
    }
  }
  return true;
}

std::vector<Corner> CornersOfRows(const GrayLevel& level, int begin, int end,
                                  const KltOptions& options) {
  const ImageF scores = CornerScores(level, begin - 1, end + 1);
  const float min_score = static_cast<float>(options.min_eigenvalue);
  std::vector<Corner> corners;
  for (int r = begin; r < end; ++r) {
    for (int c = 0; c < level.cols; ++c) {
      const float score = scores(r - begin + 1, c + 1);
      if (score < min_score || !IsPeak(scores, r - begin + 1, c + 1)) continue;
      if (!IsInsidePicture({c + 0.5, r + 0.5}, level.rows, level.cols, options)) continue;
      corners.push_back({score, r, c});
    }
  }
  return corners;
}

std::vector<Corner> CornersBestFirst(const GrayLevel& level, const KltOptions& options,
                                     RunContext& context) {
  const int num_bands = (level.rows + kBandRows - 1) / kBandRows;
  std::vector<std::vector<Corner>> bands(static_cast<size_t>(num_bands));
  ParallelFor(context, "", num_bands, [&](int64_t band) {
    const int begin = static_cast<int>(band) * kBandRows;
    bands[static_cast<size_t>(band)] =
        CornersOfRows(level, begin, std::min(begin + kBandRows, level.rows), options);
  });
  std::vector<Corner> corners;
  for (const auto& band : bands) corners.insert(corners.end(), band.begin(), band.end());
  std::stable_sort(corners.begin(), corners.end(),
                   [](const Corner& a, const Corner& b) { return a.score > b.score; });
  return corners;
}

}  // namespace

bool IsInsidePicture(const Vector2d& position_px, int rows, int cols, const KltOptions& options) {
  const double margin = 0.5 * options.window_px;
  const double skipped = std::max(margin, options.skipped_rows_share * rows);
  if (position_px.y() < skipped || position_px.y() > rows - skipped) return false;
  return options.wraps_around || (position_px.x() >= margin && position_px.x() <= cols - margin);
}

SpacedPositions::SpacedPositions(int rows, int cols, double spacing_px, bool wraps_around)
    : spacing_px_(spacing_px),
      cols_px_(cols),
      wraps_around_(wraps_around),
      num_cell_rows_(std::max(1, static_cast<int>(std::ceil(rows / spacing_px)))),
      // Rounded down, so that the cells of a picture that wraps round are none narrower.
      num_cell_cols_(std::max(1, static_cast<int>(std::floor(cols / spacing_px)))),
      cells_(static_cast<size_t>(num_cell_rows_) * static_cast<size_t>(num_cell_cols_)) {}

int SpacedPositions::CellCol(double x) const {
  return std::clamp(static_cast<int>(x / cols_px_ * num_cell_cols_), 0, num_cell_cols_ - 1);
}

int SpacedPositions::CellRow(double y) const {
  return std::clamp(static_cast<int>(y / spacing_px_), 0, num_cell_rows_ - 1);
}

bool SpacedPositions::IsFree(const Vector2d& position_px) const {
  const int row = CellRow(position_px.y()), col = CellCol(position_px.x());
  for (int r = std::max(row - 1, 0); r <= std::min(row + 1, num_cell_rows_ - 1); ++r) {
    for (int c = col - 1; c <= col + 1; ++c) {
      if (!wraps_around_ && (c < 0 || c >= num_cell_cols_)) continue;
      const int wrapped = (c + num_cell_cols_) % num_cell_cols_;
      for (const Vector2d& other : cells_[static_cast<size_t>(r * num_cell_cols_ + wrapped)]) {
        Vector2d apart = position_px - other;
        if (wraps_around_) apart.x() = std::remainder(apart.x(), cols_px_);
        if (apart.squaredNorm() < spacing_px_ * spacing_px_) return false;
      }
    }
  }
  return true;
}

void SpacedPositions::Add(const Vector2d& position_px) {
  const int cell = CellRow(position_px.y()) * num_cell_cols_ + CellCol(position_px.x());
  cells_[static_cast<size_t>(cell)].push_back(position_px);
}

bool SpacedPositions::TryAdd(const Vector2d& position_px) {
  if (!IsFree(position_px)) return false;
  Add(position_px);
  return true;
}

std::vector<Vector2d> DetectFeatures(const GrayPyramid& picture,
                                     std::span<const Vector2d> existing_px,
                                     const KltOptions& options, RunContext& context) {
  const GrayLevel& level = picture.level(0);
  const int num_missing = options.max_features - static_cast<int>(existing_px.size());
  std::vector<Vector2d> found;
  if (num_missing <= 0 || level.rows == 0 || level.cols == 0) return found;
  SpacedPositions spaced(level.rows, level.cols, options.min_distance_px, picture.wraps_around());
  for (const Vector2d& position : existing_px) spaced.Add(position);
  for (const Corner& corner : CornersBestFirst(level, options, context)) {
    const Vector2d position(corner.col + 0.5, corner.row + 0.5);
    if (!spaced.TryAdd(position)) continue;
    found.push_back(position);
    if (static_cast<int>(found.size()) == num_missing) break;
  }
  return found;
}

}  // namespace enfilade
