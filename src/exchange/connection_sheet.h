// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "src/exchange/connection_facts.h"
#include "src/exchange/plan_sheet.h"

namespace enfilade {

inline constexpr double kMapWidth_mm = 297;
inline constexpr double kMapTitleBlock_mm = 27;  ///< height of the strip at the bottom
inline constexpr double kPanelPadding_mm = 4;
inline constexpr double kPanelHeading_mm = 11;  ///< height of the two lines above a panel's map

/// Where one component is drawn, or where the pictures without any tie are listed.
struct MapPanel {
  int component = -1;            ///< into ConnectionFacts::components, −1 for the list
  std::string heading, details;  ///< the two lines
  Eigen::AlignedBox2d box_mm;
  PaperFrame frame;
};

struct MapSheet {
  double scale_denominator = 100;  ///< N of 1:N
  double height_mm = 210;
  std::vector<MapPanel> panels;             ///< components first
  std::vector<Eigen::Vector2d> cameras_mm;  ///< one a view
  /// 1 where cameras lie far apart on the sheet, down to 0.35 where they are crowded: the size of
  /// what is drawn at them.
  double symbol_scale = 1;
};

/// Lays the components out in rows, or the rows beside the first component where that is less
/// high, at the largest scale that needs no more than about A4. The list of pictures without ties
/// takes a row of its own.
[[nodiscard]] MapSheet LayOutMap(const ConnectionFacts& facts);

/// The picture's name as the list shows it: whole where it is not too long.
[[nodiscard]] std::string ListName(const ViewFact& view);

}  // namespace enfilade
