// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "enfilade/base/options.h"
#include "enfilade/floorplan/types.h"

namespace enfilade {

struct PlanSvgOptions {
  std::string title = "Floor plan";
  bool show_wall_dimensions = true;
  bool show_cameras = true;

  void Visit(OptionVisitor& v) {
    v("title", title, "Title on the sheet.");
    v("show_wall_dimensions", show_wall_dimensions,
      "Length of every wall's inner face that there is room for.");
    v("show_cameras", show_cameras, "Where the pictures were taken.");
  }
};

/// The plan as an SVG drawing true to scale: one user unit is one millimetre on paper, at the
/// largest of 1:50, 1:100 and 1:200 at which all storeys (side by side or stacked) fit A4 or else
/// A3; larger plans go to 1:500 and 1:1000 and then to a sheet made to measure. Printed without
/// scaling, lengths can be taken with a ruler.
///
/// Layers (Inkscape and plain groups): sheet, and per storey rooms, walls, openings, dimensions,
/// labels and cameras. A room's path has data-room and data-area-m2, a wall's inner face data-wall,
/// data-length-m, data-thickness-m and data-seen. Wall bodies are drawn from the inner face to the
/// outer one that the plan measured or assumed; what was inferred is dashed. Dimensions are in
/// metres between inner faces. Text is UTF-8; styling is in one style element.
///
/// Same plan, same bytes.
[[nodiscard]] std::string FormatPlanSvg(const Floorplan& plan, const PlanSvgOptions& options = {});

/// Writes FormatPlanSvg atomically. Throws IoError.
void WritePlanSvg(const std::filesystem::path& path, const Floorplan& plan,
                  const PlanSvgOptions& options = {});

}  // namespace enfilade
