// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/image/superpixels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

constexpr int kRows = 200, kCols = 400;

// A picture painted by colour(row, col, channel).
template <typename Colour>
ImageU8 Paint(const Colour& colour) {
  ImageU8 picture(kRows, kCols, 3);
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < kCols; ++c) {
      for (int k = 0; k < 3; ++k) picture(r, c, k) = static_cast<uint8_t>(colour(r, c, k));
    }
  }
  return picture;
}

ImageU8 Noise(int amplitude) {
  std::mt19937 random(7);
  return Paint([&](int, int, int) {
    return 128 + static_cast<int>(random() % static_cast<unsigned>(amplitude + 1)) - amplitude / 2;
  });
}

SuperpixelOptions Few() {
  SuperpixelOptions options;
  options.count = 300;
  return options;
}

// Number of 4-connected pieces, round the azimuth, that the labels fall into.
int NumPieces(const Image<int>& label) {
  Image<int> seen(label.rows(), label.cols());
  int count = 0;
  for (int r0 = 0; r0 < label.rows(); ++r0) {
    for (int c0 = 0; c0 < label.cols(); ++c0) {
      if (seen(r0, c0) != 0) continue;
      ++count;
      std::vector<std::pair<int, int>> stack = {{r0, c0}};
      while (!stack.empty()) {
        const auto [r, c] = stack.back();
        stack.pop_back();
        if (r < 0 || r >= label.rows()) continue;
        const int col = (c + label.cols()) % label.cols();
        if (seen(r, col) != 0 || label(r, col) != label(r0, c0)) continue;
        seen(r, col) = 1;
        for (const auto& [i, j] : {std::pair(r - 1, col), std::pair(r + 1, col),
                                   std::pair(r, col - 1), std::pair(r, col + 1)})
          stack.emplace_back(i, j);
      }
    }
  }
  return count;
}

TEST(Superpixels, AreConnectedAndNumberedInOrder) {
  for (const int amplitude : {0, 40, 160}) {
    const Superpixels found = MakeSuperpixels(Noise(amplitude), Few());
    int next = 0;
    for (const int label : found.label.data()) {
      ASSERT_LE(label, next);
      next = std::max(next, label + 1);
    }
    EXPECT_EQ(next, static_cast<int>(found.pixels.size()));
    EXPECT_EQ(NumPieces(found.label), next) << amplitude;
  }
}

TEST(Superpixels, CoverEqualSolidAngles) {
  const Superpixels found = MakeSuperpixels(Noise(0), Few());
  EXPECT_NEAR(static_cast<double>(found.pixels.size()), 300, 15);
  double sum = 0;
  for (const Superpixel& pixel : found.pixels) {
    sum += pixel.solid_angle_sr;
    EXPECT_NEAR(pixel.solid_angle_sr, 4 * kPi / 300, 0.45 * 4 * kPi / 300);
  }
  EXPECT_NEAR(sum, 4 * kPi, 1e-3);
}

TEST(Superpixels, TellTheirMeans) {
  // Grey 119 has L 50.03.
  const Superpixels found = MakeSuperpixels(Paint([](int, int, int) { return 119; }), Few());
  for (size_t i = 0; i < found.pixels.size(); ++i) {
    EXPECT_NEAR(found.pixels[i].lab[0], 50.03, 0.3);
    EXPECT_NEAR(found.pixels[i].lab[1], 0, 0.3);
    const auto& d = found.pixels[i].direction;
    EXPECT_NEAR(std::hypot(d[0], d[1], d[2]), 1, 1e-5);
  }
  EXPECT_GT(found.pixels.front().direction[2], 0.9);
  EXPECT_LT(found.pixels.back().direction[2], -0.9);
  const int middle = found.label(kRows / 2, kCols / 4);  // azimuth −90°
  EXPECT_LT(found.pixels[static_cast<size_t>(middle)].direction[1], -0.95);
}

// A slanted edge, and one beside the seam, as a superpixel's size or more from any other.
TEST(Superpixels, DoNotCrossEdges) {
  const auto is_bright = [](int r, int c) {
    return r > 100 + 30 * std::sin(2 * kPi * c / kCols) || (c > kCols - 25 && r > 40);
  };
  const Superpixels found =
      MakeSuperpixels(Paint([&](int r, int c, int) { return is_bright(r, c) ? 150 : 110; }), Few());
  std::vector<std::pair<int, int>> counts(found.pixels.size());
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < kCols; ++c) {
      auto& [bright, dark] = counts[static_cast<size_t>(found.label(r, c))];
      (is_bright(r, c) ? bright : dark) += 1;
    }
  }
  int strays = 0;
  for (const auto& [bright, dark] : counts) strays += std::min(bright, dark);
  EXPECT_LE(strays, kRows * kCols / 1000);
}

TEST(Superpixels, HaveNoSeam) {
  const Superpixels found = MakeSuperpixels(Noise(10), Few());
  int across = 0;
  for (int r = 0; r < kRows; ++r) across += found.label(r, 0) == found.label(r, kCols - 1);
  // Elsewhere a superpixel ends between two columns in about one row of fifteen.
  int inside = 0;
  for (int r = 0; r < kRows; ++r) inside += found.label(r, 171) == found.label(r, 172);
  EXPECT_GT(across, kRows / 2);
  EXPECT_GT(inside, kRows / 2);
}

TEST(Superpixels, SmallAndPlainPicturesWork) {
  SuperpixelOptions options;
  for (const int rows : {1, 2, 3, 8}) {
    for (const int count : {10, 3000}) {
      options.count = count;
      const Superpixels found = MakeSuperpixels(ImageU8(rows, 2 * rows, 3, 40), options);
      EXPECT_GE(found.pixels.size(), 1U);
      EXPECT_EQ(found.label.rows(), rows);
      EXPECT_LT(*std::max_element(found.label.data().begin(), found.label.data().end()),
                static_cast<int>(found.pixels.size()));
    }
  }
}

}  // namespace
}  // namespace enfilade
