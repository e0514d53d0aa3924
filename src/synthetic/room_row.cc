// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/room_row.h"

#include <cmath>

namespace enfilade {

using Eigen::Vector2d;

std::optional<std::vector<Rectangle>> DivideRow(const Vector2d& low, double length_m,
                                                double depth_m, int count, Random& random) {
  constexpr double kMinWidth_m = 2.3;
  std::vector<double> share, wall_m;
  double sum = 0, usable_m = length_m;
  for (int i = 0; i < count; ++i) {
    share.push_back(random.Uniform(0.75, 1.3));
    sum += share.back();
    wall_m.push_back(i + 1 < count ? InnerThickness(random) : 0.0);
    usable_m -= wall_m.back();
  }
  std::vector<Rectangle> row;
  double x = low.x();
  for (size_t i = 0; i < share.size(); ++i) {
    const double end = i + 1 < share.size()
                           ? x + std::round(1000 * usable_m * share[i] / sum) / 1000
                           : low.x() + length_m;
    if (end - x < kMinWidth_m) return std::nullopt;
    row.push_back({{x, low.y()}, {end, low.y() + depth_m}});
    x = end + wall_m[i];
  }
  return row;
}

}  // namespace enfilade
