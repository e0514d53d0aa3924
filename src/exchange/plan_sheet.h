// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace enfilade {

/// From the home plan in metres (y up) to the sheet in millimetres (y down).
struct PaperFrame {
  double mm_per_m = 10;
  Eigen::Vector2d origin_mm{0, 0};  ///< where the home's (0, 0) lies on the sheet

  [[nodiscard]] Eigen::Vector2d operator*(const Eigen::Vector2d& home) const {
    return {origin_mm.x() + mm_per_m * home.x(), origin_mm.y() - mm_per_m * home.y()};
  }
};

/// A sheet of paper with one frame per storey.
struct PlanSheet {
  std::string format;           ///< "A4", "A3" or "custom"
  int scale_denominator = 100;  ///< N of 1:N
  double width_mm = 297;
  double height_mm = 210;
  std::vector<PaperFrame> frames;
};

/// Widths that the layout keeps free.
inline constexpr double kSheetMargin_mm = 8;      ///< between the sheet's edge and its border
inline constexpr double kTitleBlock_mm = 20;      ///< height of the strip at the bottom
inline constexpr double kDimensionSpace_mm = 13;  ///< left of and below a storey
inline constexpr double kStoreyGap_mm = 5;        ///< right of and above it

/// Chooses scale, format and arrangement for drawings of the given extents: the largest of 1:50,
/// 1:100, 1:200, 1:500, 1:1000 that fits A4 or else A3, landscape before portrait, a row of storeys
/// before a column.
[[nodiscard]] PlanSheet LayOutSheet(const std::vector<Eigen::AlignedBox2d>& extents_m);

}  // namespace enfilade
