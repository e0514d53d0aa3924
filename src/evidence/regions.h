// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "enfilade/image/image.h"

namespace enfilade {

using ImageI = Image<int>;

/// Row and column steps to the cells round one. The first four share a side with it.
inline constexpr std::array<std::pair<int, int>, 8> kNeighbours{
    {{-1, 0}, {0, -1}, {0, 1}, {1, 0}, {-1, -1}, {-1, 1}, {1, -1}, {1, 1}}};

enum class Connectivity { kFour, kEight };

/// Connected components: 0 where `mask` is 0, else 1, 2, … in the order of their first pixel.
struct Components {
  ImageI label;
  std::vector<int> num_cells;  ///< by label; [0] is unused
  [[nodiscard]] int count() const { return static_cast<int>(num_cells.size()) - 1; }
};
[[nodiscard]] Components LabelComponents(const ImageU8& mask, Connectivity connectivity);

/// Gives every pixel of `mask` that is 4-connected to a seed (label > 0) within it the label of the
/// nearest one by steps; ties go to the seed met first row by row. Others stay 0.
[[nodiscard]] ImageI GrowLabels(const ImageI& seeds, const ImageU8& mask);

}  // namespace enfilade
