// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/image/image.h"

namespace enfilade {

using ImageI = Image<int>;

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
