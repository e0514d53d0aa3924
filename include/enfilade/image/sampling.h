// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "enfilade/image/image.h"

namespace enfilade {

/// Bilinear sample of one channel at (x, y) in pixels (centre of the top-left pixel at 0.5, 0.5);
/// clamped at the border. The picture must not be empty, x and y finite.
template <typename T>
[[nodiscard]] float SampleBilinear(const Image<T>& image, double x, double y, int channel = 0) {
  const double u = std::clamp(x - 0.5, 0.0, image.cols() - 1.0);
  const double v = std::clamp(y - 0.5, 0.0, image.rows() - 1.0);
  const int c0 = static_cast<int>(u), r0 = static_cast<int>(v);
  const int c1 = std::min(c0 + 1, image.cols() - 1), r1 = std::min(r0 + 1, image.rows() - 1);
  const float a = static_cast<float>(u - c0), b = static_cast<float>(v - r0);
  const float top = (1 - a) * static_cast<float>(image(r0, c0, channel)) +
                    a * static_cast<float>(image(r0, c1, channel));
  const float bottom = (1 - a) * static_cast<float>(image(r1, c0, channel)) +
                       a * static_cast<float>(image(r1, c1, channel));
  return (1 - b) * top + b * bottom;
}

/// As SampleBilinear for equirectangular pictures: x wraps round, y is clamped at the poles.
template <typename T>
[[nodiscard]] float SampleBilinearWrapped(const Image<T>& image, double x, double y,
                                          int channel = 0) {
  const double width = image.cols();
  double u = x - 0.5;
  if (u < 0 || u >= width) u -= width * std::floor(u / width);
  const double v = std::clamp(y - 0.5, 0.0, image.rows() - 1.0);
  const int c0 = std::min(static_cast<int>(u), image.cols() - 1), r0 = static_cast<int>(v);
  const int c1 = c0 + 1 < image.cols() ? c0 + 1 : 0, r1 = std::min(r0 + 1, image.rows() - 1);
  const float a = static_cast<float>(u - c0), b = static_cast<float>(v - r0);
  const float top = (1 - a) * static_cast<float>(image(r0, c0, channel)) +
                    a * static_cast<float>(image(r0, c1, channel));
  const float bottom = (1 - a) * static_cast<float>(image(r1, c0, channel)) +
                       a * static_cast<float>(image(r1, c1, channel));
  return (1 - b) * top + b * bottom;
}

}  // namespace enfilade
