// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "src/synthetic/furniture.h"

namespace enfilade {

inline constexpr std::array<std::array<float, 3>, 5> kWoods = {{{0.42f, 0.26f, 0.14f},
                                                                {0.55f, 0.40f, 0.25f},
                                                                {0.25f, 0.15f, 0.09f},
                                                                {0.72f, 0.70f, 0.66f},
                                                                {0.62f, 0.50f, 0.35f}}};
inline constexpr std::array<std::array<float, 3>, 6> kFabrics = {{{0.22f, 0.25f, 0.30f},
                                                                  {0.45f, 0.40f, 0.34f},
                                                                  {0.16f, 0.24f, 0.22f},
                                                                  {0.50f, 0.22f, 0.14f},
                                                                  {0.30f, 0.30f, 0.31f},
                                                                  {0.58f, 0.55f, 0.50f}}};

struct Look {
  Eigen::Vector3f rgb;
  Finish finish = Finish::kPlain;
};

inline Look operator*(float factor, const Look& look) { return {factor * look.rgb, look.finish}; }

template <size_t N>
Look Pick(const std::array<std::array<float, 3>, N>& colours, Finish finish, Random& random) {
  const auto& c = colours[static_cast<size_t>(random.Index(static_cast<int>(N)))];
  return {Eigen::Vector3f(c[0], c[1], c[2]) * static_cast<float>(random.Uniform(0.85, 1.1)),
          finish};
}

inline Look Wood(Random& random) { return Pick(kWoods, Finish::kWood, random); }
inline Look Fabric(Random& random) { return Pick(kFabrics, Finish::kFabric, random); }

/// Adds the box [x0, x1] × [y0, y1] × [z0, z1] in the frame of the piece.
inline void Add(FurniturePiece& piece, Eigen::Vector2d x, Eigen::Vector2d y, Eigen::Vector2d z,
                const Look& look) {
  HomeBox box;
  box.center = {0.5 * (x[0] + x[1]), 0.5 * (y[0] + y[1])};
  box.size = {x[1] - x[0], y[1] - y[0]};
  box.z0 = z[0];
  box.z1 = z[1];
  box.rgb = look.rgb;
  box.finish = look.finish;
  piece.boxes.push_back(box);
}

}  // namespace enfilade
