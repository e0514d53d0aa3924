// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/geometry/polygon2.h"
#include "enfilade/image/image.h"
#include "src/floorplan/loop_field.h"

namespace enfilade {

/// What a change of a room's outline takes away and adds.
struct ChangeSums {
  double free_lost_m2 = 0;     ///< free space, as sure as it is
  double solid_gained_m2 = 0;  ///< solid wall, likewise
  double foreign_gained_m2 = 0;
};

/// The part of the evidence about a room, summed up along its rows so that the sums over any region
/// take only as long as its rows.
class EvidenceSums {
 public:
  /// Cells [first_row, first_row + rows) × [first_col, first_col + cols) of the field. `foreign`
  /// has their size: cells that the room must not take.
  EvidenceSums(const LoopField& field, int first_row, int first_col, const ImageU8& foreign);

  /// Whether the window holds all vertices.
  [[nodiscard]] bool Covers(const Ring2& ring) const;

  /// Sums over the regions that a closed walk, which Covers, goes round: counter-clockwise they are
  /// added, clockwise taken away, as often as it goes round them. Exact for walks along the axes.
  [[nodiscard]] ChangeSums Measure(const Ring2& change) const;

 private:
  struct Sum {
    double free = 0, solid = 0, foreign = 0;
  };
  /// Sums over the first `columns` of a row, in cells.
  [[nodiscard]] Sum Before(int row, double columns) const;

  double cell_m_;
  Eigen::Vector2d origin_;
  int rows_, cols_;
  std::vector<Sum> sums_;  // rows × (cols + 1)
};

}  // namespace enfilade
