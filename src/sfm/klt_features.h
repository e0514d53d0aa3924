// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "enfilade/sfm/klt_tracker.h"

namespace enfilade {

/// Corners are found by the gradients in so many pixels, a part of the window.
inline constexpr int kCornerSize_px = 5;
inline constexpr int kCornerArea = kCornerSize_px * kCornerSize_px;

/// True when the window round the position lies in the picture and in the rows in use.
[[nodiscard]] bool IsInsidePicture(const Eigen::Vector2d& position_px, int rows, int cols,
                                   const KltOptions& options);

/// Positions that are all at least `spacing_px` apart, in cells of that size. Across the left and
/// right edge too when the picture wraps round.
class SpacedPositions {
 public:
  SpacedPositions(int rows, int cols, double spacing_px, bool wraps_around);

  /// Adds the position if it keeps its distance; returns whether it did.
  bool TryAdd(const Eigen::Vector2d& position_px);
  void Add(const Eigen::Vector2d& position_px);

 private:
  [[nodiscard]] int CellCol(double x) const;
  [[nodiscard]] int CellRow(double y) const;
  [[nodiscard]] bool IsFree(const Eigen::Vector2d& position_px) const;

  double spacing_px_;
  double cols_px_;
  bool wraps_around_;
  int num_cell_rows_, num_cell_cols_;
  std::vector<std::vector<Eigen::Vector2d>> cells_;
};

}  // namespace enfilade
