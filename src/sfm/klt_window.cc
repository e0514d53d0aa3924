// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/klt_window.h"

#include <cmath>

#include "enfilade/base/check.h"

namespace enfilade {
namespace {

// Rows of windows are fixed-size arrays: Eigen makes vector code of them, whose sums have a fixed
// order.
template <int kSize>
using Row = Eigen::Array<float, kSize, 1>;
template <int kSize>
using RowMap = Eigen::Map<Row<kSize>>;
template <int kSize>
using ConstRowMap = Eigen::Map<const Row<kSize>>;

// Samples rows of a window, all with the same fractions of a pixel, from top to bottom.
template <int kSize>
class RowSampler {
 public:
  // (x, y): of the first sample in pixels of the picture.
  RowSampler(const ImageF& padded, double x, double y) : stride_(padded.cols()) {
    const double u = x + (GrayLevel::kBorder_px - 0.5), v = y + (GrayLevel::kBorder_px - 0.5);
    const double col = std::floor(u), row = std::floor(v);
    a_ = static_cast<float>(u - col);
    b_ = static_cast<float>(v - row);
    source_ = padded.row(static_cast<int>(row)) + static_cast<int>(col);
    upper_ = Across(source_);
  }

  Row<kSize> Next() {
    source_ += stride_;
    const Row<kSize> lower = Across(source_);
    const Row<kSize> row = upper_ + b_ * (lower - upper_);
    upper_ = lower;
    return row;
  }

 private:
  Row<kSize> Across(const float* source) const {
    const ConstRowMap<kSize> left(source), right(source + 1);
    return left + a_ * (right - left);
  }

  std::ptrdiff_t stride_;
  float a_, b_;
  const float* source_;
  Row<kSize> upper_;
};

// 1 for the samples of a window that lie within 0 … length, else 0: the border is made up.
template <int kSize>
Row<kSize> InsideMask(double first, double length) {
  Row<kSize> mask;
  for (int i = 0; i < kSize; ++i) mask[i] = first + i >= 0 && first + i <= length ? 1.0f : 0.0f;
  return mask;
}

template <int kSize>
constexpr double kHalf = 0.5 * (kSize - 1);

template <int kSize>
Eigen::Matrix2d Cut(const GrayLevel& level, const Eigen::Vector2d& position, float* planes) {
  constexpr int kArea = kSize * kSize, kWide = kSize + 4;
  const double first_x = position.x() - kHalf<kSize>, first_y = position.y() - kHalf<kSize>;
  // One pixel more on every side for the gradients, and two that fill up the row.
  float gray[(kSize + 2) * kWide];
  RowSampler<kWide> rows(level.gray, first_x - 1, first_y - 1);
  for (int r = 0; r < kSize + 2; ++r) RowMap<kWide>(gray + r * kWide) = rows.Next();
  const Row<kSize> inside_rows = InsideMask<kSize>(first_y, level.rows);
  const Row<kSize> inside_cols =
      level.wraps_around ? Row<kSize>(Row<kSize>::Ones()) : InsideMask<kSize>(first_x, level.cols);
  Row<kSize> xx = Row<kSize>::Zero(), xy = xx, yy = xx;
  for (int r = 0; r < kSize; ++r, planes += kSize) {
    const float* middle = gray + (r + 1) * kWide + 1;
    const ConstRowMap<kSize> here(middle), left(middle - 1), right(middle + 1),
        above(middle - kWide), below(middle + kWide);
    const Row<kSize> mask = inside_rows[r] * (here < kClippedGray).select(inside_cols, 0.0f);
    const Row<kSize> gx = 0.5f * mask * (right - left), gy = 0.5f * mask * (below - above);
    RowMap<kSize>{planes} = here;
    RowMap<kSize>{planes + kArea} = gx;
    RowMap<kSize>{planes + 2 * kArea} = gy;
    RowMap<kSize>{planes + 3 * kArea} = mask;
    xx += gx * gx;
    xy += gx * gy;
    yy += gy * gy;
  }
  Eigen::Matrix2d tensor;
  tensor << xx.sum(), xy.sum(), xy.sum(), yy.sum();
  return tensor;
}

template <int kSize>
Eigen::Vector2d GradientResidual(const GrayLevel& level, const Eigen::Vector2d& position,
                                 float inverse_gain, const float* planes) {
  constexpr int kArea = kSize * kSize;
  const float most = 255.0f * inverse_gain;
  RowSampler<kSize> rows(level.gray, position.x() - kHalf<kSize>, position.y() - kHalf<kSize>);
  Row<kSize> x = Row<kSize>::Zero(), y = x;
  for (int r = 0; r < kSize; ++r, planes += kSize) {
    const ConstRowMap<kSize> first(planes), gx(planes + kArea), gy(planes + 2 * kArea);
    const Row<kSize> e = inverse_gain * rows.Next() - first.min(most);
    x += gx * e;
    y += gy * e;
  }
  return {x.sum(), y.sum()};
}

template <int kSize>
WindowSums Sums(const GrayLevel& level, const Eigen::Vector2d& position, float inverse_gain,
                const float* planes) {
  constexpr int kArea = kSize * kSize;
  const float most = 255.0f * inverse_gain, unclipped = kClippedGray * inverse_gain;
  RowSampler<kSize> rows(level.gray, position.x() - kHalf<kSize>, position.y() - kHalf<kSize>);
  Row<kSize> x = Row<kSize>::Zero(), y = x, e2 = x, k = x, kx = x, ky = x, ke = x;
  for (int r = 0; r < kSize; ++r, planes += kSize) {
    const ConstRowMap<kSize> first(planes), gx(planes + kArea), gy(planes + 2 * kArea),
        mask(planes + 3 * kArea);
    const Row<kSize> e = mask * (inverse_gain * rows.Next() - first.min(most));
    const Row<kSize> t = (first < unclipped).select(mask * first, 0.0f);
    x += gx * e;
    y += gy * e;
    e2 += e * e;
    k += t * t;
    kx += t * gx;
    ky += t * gy;
    ke += t * e;
  }
  WindowSums sums;
  sums.block.coupling = {kx.sum(), ky.sum()};
  sums.block.gain = k.sum();
  sums.block.gradient_residual = {x.sum(), y.sum()};
  sums.block.gain_residual = ke.sum();
  sums.residual2 = e2.sum();
  return sums;
}

template <int kSize>
constexpr WindowKernel kKernel = {Cut<kSize>, GradientResidual<kSize>, Sums<kSize>};

}  // namespace

const WindowKernel& KernelOfWindow(int window_px) {
  switch (window_px) {
    case 8:
      return kKernel<8>;
    case 12:
      return kKernel<12>;
    case 16:
      return kKernel<16>;
    case 20:
      return kKernel<20>;
    default:
      ENFILADE_CHECK(window_px == 24);
      return kKernel<24>;
  }
}

}  // namespace enfilade
