// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "enfilade/scene/types.h"

namespace enfilade {

/// An upright rectangle of one brightness, in the plane x = offset (axis 0) or y = offset (axis 1).
struct PaintedQuad {
  int axis = 0;
  double offset = 0;
  double from = 0, to = 0;  ///< along the other axis
  double low_z = 0, high_z = 2.4;
  uint8_t gray = 200;
};

/// The four walls of a box, 2.4 m high, with a darker baseboard of 8 cm.
[[nodiscard]] std::vector<PaintedQuad> PaintBox(double min_x, double min_y, double max_x,
                                                double max_y);

/// An equirectangular picture of the quads, the nearest first, from `position` looking along +y,
/// floor and ceiling (z 0 and 2.4) in two greys; written as PNG. The view's frame is the home's.
[[nodiscard]] View PaintView(const std::vector<PaintedQuad>& quads, const Eigen::Vector3d& position,
                             const std::filesystem::path& path);

}  // namespace enfilade
