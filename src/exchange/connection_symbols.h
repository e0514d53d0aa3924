// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "src/exchange/connection_facts.h"
#include "src/exchange/connection_sheet.h"

namespace pugi {
class xml_node;
}

namespace enfilade {

/// Width of the line of a pair that ties its cameras. Here and below `scale` is
/// MapSheet::symbol_scale.
[[nodiscard]] double TieWidth(int num_inliers, double scale);

/// A camera's dot at a place on the sheet.
pugi::xml_node AppendCamera(pugi::xml_node parent, const Eigen::Vector2d& center, bool is_inferred,
                            double scale);

/// The wedge that shows where the picture's centre looks.
pugi::xml_node AppendWedge(pugi::xml_node parent, const Eigen::Vector2d& tip, double yaw_rad,
                           double scale);

/// Paper and border, and at the bottom title, figures, legend and scale bar.
void DrawTitleBlock(const ConnectionFacts& facts, const MapSheet& sheet, pugi::xml_node root);

}  // namespace enfilade
