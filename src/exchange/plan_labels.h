// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "enfilade/floorplan/types.h"
#include "src/exchange/plan_sheet.h"
#include "src/exchange/svg_elements.h"

namespace enfilade {

/// A rectangle on the sheet, turned so that its width runs along `axis`.
struct TurnedBox {
  Eigen::Vector2d center{0, 0};
  Eigen::Vector2d axis{1, 0};  ///< unit
  double half_width_mm = 0;
  double half_height_mm = 0;
};

/// True when the boxes share a point (separating axes).
[[nodiscard]] bool Overlap(const TurnedBox& a, const TurnedBox& b);

/// What stands in the middle of a room.
struct RoomLabel {
  int room_id = 0;
  std::vector<TextLine> lines;
};

/// A dimension between two points, drawn as a line beside them.
struct DimensionLine {
  int wall_id = -1;                                    ///< −1 for the storey's overall dimensions
  Eigen::Vector2d measured_a{0, 0}, measured_b{0, 0};  ///< on the sheet
  Eigen::Vector2d line_a{0, 0}, line_b{0, 0};
  TextLine text;
};

struct StoreyLabels {
  std::vector<RoomLabel> rooms;
  std::vector<DimensionLine> dimensions;
};

/// Places the storey's lettering so that nothing in it overlaps: first every room's name, area and
/// height where there is most space, then the lengths of the walls' inner faces, long ones first,
/// inside their room. A wall whose length can be read off an opposite wall, or for which there is
/// no space, gets no dimension. Last come width and depth of the storey, outside. Room labels keep
/// off the points `avoided` (on the sheet) where there is a choice.
[[nodiscard]] StoreyLabels PlaceLabels(const Storey& storey, const PaperFrame& frame,
                                       const Eigen::AlignedBox2d& extent_m,
                                       const std::vector<Eigen::Vector2d>& avoided,
                                       bool with_wall_dimensions);

/// Width of a text on paper: that of the widest usual sans serif, so that it suits all.
[[nodiscard]] double TextWidth(std::string_view utf8, double size_mm);

}  // namespace enfilade
