// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/image/image.h"

namespace enfilade {

struct SuperpixelOptions {
  int count = 3000;
  double compactness = 6;
  int num_iterations = 5;
  double min_share = 0.25;

  void Visit(OptionVisitor& v) {
    v("count", count, "Superpixels of a panorama, about.", {10, 100000});
    v("compactness", compactness,
      "Difference in colour (CIELAB) that weighs as much as the distance of two superpixels.",
      {0.1, 1000});
    v("num_iterations", num_iterations, "Rounds of assignment.", {1, 50});
    v("min_share", min_share, "Smaller pieces, as a share of the mean size, join a neighbour.",
      {0, 1});
  }
};

/// One superpixel: means over its pixels, each by the solid angle that it covers.
struct Superpixel {
  std::array<float, 3> lab{};        ///< CIELAB, L 0–100
  std::array<float, 3> direction{};  ///< unit; z to the top row, the first column looks along −x
  float solid_angle_sr = 0;
};

struct Superpixels {
  Image<int> label;                ///< rows × cols, into `pixels`
  std::vector<Superpixel> pixels;  ///< in the order of their first pixels, row by row
};

/// Superpixels of an equirectangular panorama (rows × 2·rows × 3, RGB): connected, about equal in
/// solid angle, bounded where colours change, with no seam between the last and the first column.
///
/// SLIC (Achanta, Shaji, Smith, Lucchi, Fua and Süsstrunk, PAMI 2012) on the sphere: seeds stand in
/// bands of equal height, as many in each as its circumference has room for, and pixels and centres
/// are compared by the chord between their directions. A pixel compares the nine seeds about its
/// place and keeps no more than one of these, so that the cost is linear in pixels and independent
/// of the count. Pieces that hang together with nothing else and are smaller than min_share of the
/// mean join the neighbour of the most similar colour.
[[nodiscard]] Superpixels MakeSuperpixels(const ImageU8& panorama,
                                          const SuperpixelOptions& options);

}  // namespace enfilade
