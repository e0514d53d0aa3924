// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/structure/seen_margin.h"

#include <algorithm>

namespace enfilade {

ImageU8 SeenWithMargin(const LevelPanorama& panorama, int margin_px) {
  const int rows = panorama.rows(), cols = panorama.cols();
  ImageU8 seen(rows, cols, 1, 1), result(rows, cols, 1, 1);
  // Every unseen pixel takes away its neighbours, first along the row, then along the column.
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < cols; ++c) {
      if (panorama.is_seen(r, c)) continue;
      for (int d = -margin_px; d <= margin_px; ++d) seen(r, ((c + d) % cols + cols) % cols) = 0;
    }
  }
  for (int r = 0; r < rows; ++r) {
    const int first = std::max(0, r - margin_px), last = std::min(rows - 1, r + margin_px);
    for (int i = first; i <= last; ++i) {
      for (int c = 0; c < cols; ++c) result(r, c) &= seen(i, c);
    }
  }
  return result;
}

}  // namespace enfilade
