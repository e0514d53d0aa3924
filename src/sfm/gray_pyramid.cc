// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/gray_pyramid.h"

#include <algorithm>
#include <cstdint>

namespace enfilade {
namespace {

constexpr int kBorder = GrayLevel::kBorder_px;
constexpr int kMinSide_px = 16;
constexpr int kBandRows = 128;
void ForRowBands(int rows, RunContext& context, const std::function<void(int, int)>& body) {
  ParallelFor(context, "", (rows + kBandRows - 1) / kBandRows, [&](int64_t band) {
    const int begin = static_cast<int>(band) * kBandRows;
    body(begin, std::min(begin + kBandRows, rows));
  });
}

float* PictureRow(ImageF& padded, int row) { return padded.row(row + kBorder) + kBorder; }
const float* PictureRow(const ImageF& padded, int row) {
  return padded.row(row + kBorder) + kBorder;
}

int Wrap(int col, int cols) { return ((col % cols) + cols) % cols; }

void FillSides(float* row, int cols, bool wraps_around) {
  for (int i = 1; i <= kBorder; ++i) {
    row[-i] = row[wraps_around ? Wrap(-i, cols) : 0];
    row[cols - 1 + i] = row[wraps_around ? Wrap(cols - 1 + i, cols) : cols - 1];
  }
}

void RepeatEndRows(ImageF& padded, int rows) {
  for (int i = 1; i <= kBorder; ++i) {
    std::copy_n(padded.row(kBorder), padded.cols(), padded.row(kBorder - i));
    std::copy_n(padded.row(kBorder + rows - 1), padded.cols(), padded.row(kBorder + rows - 1 + i));
  }
}

GrayLevel MakeLevel(int rows, int cols, bool wraps_around) {
  return {rows, cols, wraps_around, ImageF(rows + 2 * kBorder, cols + 2 * kBorder)};
}

// Luma of ITU-R BT.601.
void ConvertRow(const uint8_t* source, int cols, int channels, float* gray) {
  if (channels == 1) {
    for (int c = 0; c < cols; ++c) gray[c] = source[c];
    return;
  }
  for (int c = 0; c < cols; ++c, source += 3) {
    gray[c] = 0.299f * source[0] + 0.587f * source[1] + 0.114f * source[2];
  }
}

GrayLevel BaseLevel(const ImageU8& image, bool wraps_around, RunContext& context) {
  GrayLevel level = MakeLevel(image.rows(), image.cols(), wraps_around);
  if (image.empty()) return level;
  ForRowBands(image.rows(), context, [&](int begin, int end) {
    for (int r = begin; r < end; ++r) {
      float* gray = PictureRow(level.gray, r);
      ConvertRow(image.row(r), image.cols(), image.channels(), gray);
      FillSides(gray, image.cols(), wraps_around);
    }
  });
  RepeatEndRows(level.gray, level.rows);
  return level;
}

GrayLevel HalvedLevel(const GrayLevel& fine, RunContext& context) {
  GrayLevel level = MakeLevel(fine.rows / 2, fine.cols / 2, fine.wraps_around);
  const int num_sums = 2 * level.cols + 2;  // columns −1 … 2 cols
  ForRowBands(level.rows, context, [&](int begin, int end) {
    std::vector<float> sums(static_cast<size_t>(num_sums));
    for (int r = begin; r < end; ++r) {
      const float *r0 = PictureRow(fine.gray, 2 * r - 1) - 1,
                  *r1 = PictureRow(fine.gray, 2 * r) - 1,
                  *r2 = PictureRow(fine.gray, 2 * r + 1) - 1,
                  *r3 = PictureRow(fine.gray, 2 * r + 2) - 1;
      float* sum = sums.data();
      for (int c = 0; c < num_sums; ++c) sum[c] = r0[c] + r3[c] + 3.0f * (r1[c] + r2[c]);
      float* gray = PictureRow(level.gray, r);
      for (int c = 0; c < level.cols; ++c) {
        const float* s = sum + 2 * static_cast<ptrdiff_t>(c);
        gray[c] = (s[0] + s[3] + 3.0f * (s[1] + s[2])) * (1.0f / 64);
      }
      FillSides(gray, level.cols, level.wraps_around);
    }
  });
  RepeatEndRows(level.gray, level.rows);
  return level;
}

}  // namespace

GrayPyramid::GrayPyramid(const ImageU8& image, int max_levels, bool wraps_around,
                         RunContext& context)
    : wraps_around_(wraps_around) {
  ENFILADE_CHECK(max_levels >= 1);
  ENFILADE_CHECK(image.channels() == 1 || image.channels() == 3);
  levels_.push_back(BaseLevel(image, wraps_around, context));
  while (num_levels() < max_levels) {
    const GrayLevel& last = levels_.back();
    if (std::min(last.rows, last.cols) / 2 < kMinSide_px) break;
    if (wraps_around && last.cols % 2 != 0) break;
    levels_.push_back(HalvedLevel(last, context));
  }
}

}  // namespace enfilade
