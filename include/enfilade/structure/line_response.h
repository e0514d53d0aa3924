// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/structure/level_panorama.h"

namespace enfilade {

/// Number of families of walls: planes whose horizontal direction is 0°, 90°, 45°, 135° in the home
/// frame, and «frontal»: perpendicular to the line of sight of each column.
inline constexpr int kNumPlaneFamilies = 4;
inline constexpr int kFrontalFamily = 4;
inline constexpr int kNumFamilies = 5;

/// Horizontal direction (azimuth, radians) of the walls of a family, seen from a column.
[[nodiscard]] double WallDirection(int family, double column_azimuth_rad);

struct LineResponseOptions {
  int half_length_px = 8;
  double noise_floor = 0.6;
  double noise_factor = 2.0;

  void Visit(OptionVisitor& v) {
    v("half_length_px", half_length_px,
      "Half the length along a projected line over which the gradient is averaged, pixels.",
      {0, 10});
    v("noise_floor", noise_floor, "Gradient that halves the response on a quiet wall, grey levels.",
      {0.0, 50.0});
    v("noise_factor", noise_factor,
      "Weight of the local mean of the gradients in the normalisation.", {0.0, 10.0});
  }
};

/// How much a pixel looks like lying on a horizontal line of a family's direction, in 0–255 for
/// [0, 1): rows × num_columns of the level panorama, one picture a family.
struct LineResponse {
  std::vector<ImageU8> family;
};

/// The signed gradient across the image of a horizontal line of the family's direction through each
/// pixel is averaged along that line, which makes white-on-white edges visible, then normalised by
/// the local noise, g²/(g² + n²) with n = floor + factor·local mean of g.
///
/// `num_columns` must divide the panorama's width. `families` names the families to compute; the
/// others' pictures stay empty.
[[nodiscard]] LineResponse ComputeLineResponse(const LevelPanorama& panorama, int num_columns,
                                               std::span<const int> families,
                                               const LineResponseOptions& options);

}  // namespace enfilade
