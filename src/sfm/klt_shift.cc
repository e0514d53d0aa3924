// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/klt_shift.h"

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

constexpr int kMaxThumbnail_px = 64;
// By so much a shift must correlate better than none.
constexpr float kMinImprovement = 0.02f;

// Grey levels about their mean.
using Thumbnail = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Side of the blocks of a level that become pixels; where it wraps, a divisor of its width.
int BlockSize(const GrayLevel& level) {
  int size = (level.cols + kMaxThumbnail_px - 1) / kMaxThumbnail_px;
  while (level.wraps_around && level.cols % size != 0) ++size;
  return size;
}

Thumbnail MakeThumbnail(const GrayLevel& level, int block) {
  Thumbnail thumbnail(level.rows / block, level.cols / block);
  const int border = GrayLevel::kBorder_px;
  for (Eigen::Index r = 0; r < thumbnail.rows(); ++r) {
    for (Eigen::Index c = 0; c < thumbnail.cols(); ++c) {
      float sum = 0;
      for (int i = 0; i < block; ++i) {
        const float* row = level.gray.row(border + static_cast<int>(r) * block + i) + border;
        for (int j = 0; j < block; ++j) sum += row[c * block + j];
      }
      thumbnail(r, c) = sum;
    }
  }
  return thumbnail - thumbnail.mean();
}

// Correlation of what both thumbnails see when the second is `dx`, `dy` further on.
float Correlation(const Thumbnail& first, const Thumbnail& second, Eigen::Index dx,
                  Eigen::Index dy) {
  const Eigen::Index rows = first.rows() - std::abs(dy), cols = first.cols() - std::abs(dx);
  const auto a =
      first.block(std::max<Eigen::Index>(0, -dy), std::max<Eigen::Index>(0, -dx), rows, cols);
  const auto b =
      second.block(std::max<Eigen::Index>(0, dy), std::max<Eigen::Index>(0, dx), rows, cols);
  const float norm = std::sqrt(a.square().sum() * b.square().sum());
  return norm > 0 ? (a * b).sum() / norm : 0;
}

}  // namespace

Eigen::Vector2d ShiftOfPicture(const GrayPyramid& first, const GrayPyramid& second) {
  const int l = first.num_levels() - 1;
  const GrayLevel& level = first.level(l);
  if (level.rows == 0 || level.cols == 0) return {0, 0};
  const int block = BlockSize(level);
  if (level.rows < 4 * block || level.cols < 4 * block) return {0, 0};
  const Thumbnail a = MakeThumbnail(level, block);
  const Thumbnail b = MakeThumbnail(second.level(l), block);
  const Eigen::Index cols = a.cols(), max_dy = a.rows() / 4;
  const Eigen::Index max_dx = level.wraps_around ? cols / 2 : cols / 3;
  Eigen::Vector2d best(0, 0);
  float best_correlation = Correlation(a, b, 0, 0) + kMinImprovement;
  for (Eigen::Index dx = -max_dx; dx <= max_dx; ++dx) {
    Thumbnail turned = b;
    if (level.wraps_around) {
      for (Eigen::Index c = 0; c < cols; ++c) turned.col(c) = b.col((c + dx + cols) % cols);
    }
    for (Eigen::Index dy = -max_dy; dy <= max_dy; ++dy) {
      const float correlation = Correlation(a, turned, level.wraps_around ? 0 : dx, dy);
      if (correlation <= best_correlation) continue;
      best_correlation = correlation;
      best = {static_cast<double>(dx), static_cast<double>(dy)};
    }
  }
  return best * std::ldexp(static_cast<double>(block), l);
}

}  // namespace enfilade
