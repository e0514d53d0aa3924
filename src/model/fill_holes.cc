// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/model/fill_holes.h"

#include <algorithm>
#include <vector>

#include "enfilade/base/check.h"
#include "enfilade/image/sampling.h"

namespace enfilade {
namespace {

// Means over 2 × 2 pixels of those that have a weight.
ImageF Halve(const ImageF& image) {
  ImageF half((image.rows() + 1) / 2, (image.cols() + 1) / 2, 4);
  for (int r = 0; r < image.rows(); ++r) {
    for (int c = 0; c < image.cols(); ++c) {
      if (image(r, c, 3) <= 0) continue;
      for (int k = 0; k < 3; ++k) half(r / 2, c / 2, k) += image(r, c, k);
      half(r / 2, c / 2, 3) += 1;
    }
  }
  for (int r = 0; r < half.rows(); ++r) {
    for (int c = 0; c < half.cols(); ++c) {
      const float weight = half(r, c, 3);
      for (int k = 0; weight > 0 && k < 3; ++k) half(r, c, k) /= weight;
    }
  }
  return half;
}

void FillFrom(const ImageF& coarse, ImageF& image) {
  for (int r = 0; r < image.rows(); ++r) {
    for (int c = 0; c < image.cols(); ++c) {
      if (image(r, c, 3) > 0) continue;
      for (int k = 0; k < 3; ++k) {
        image(r, c, k) = SampleBilinear(coarse, 0.5 * (c + 0.5), 0.5 * (r + 0.5), k);
      }
    }
  }
}

}  // namespace

bool FillHoles(ImageF& rgbw) {
  ENFILADE_CHECK(rgbw.channels() == 4);
  std::vector<ImageF> pyramid{Halve(rgbw)};
  while (pyramid.back().rows() > 1 || pyramid.back().cols() > 1) {
    pyramid.push_back(Halve(pyramid.back()));
  }
  if (pyramid.back()(0, 0, 3) <= 0) return false;
  for (size_t i = pyramid.size() - 1; i > 0; --i) FillFrom(pyramid[i], pyramid[i - 1]);
  FillFrom(pyramid.front(), rgbw);
  return true;
}

}  // namespace enfilade
