// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "enfilade/scene/types.h"
#include "enfilade/sfm/types.h"

namespace enfilade {

/// What registration knows beside the scene that it made. Refers to values of the caller.
struct ConnectionReport {
  std::span<const PanoPair> pairs;        ///< of the scene's views, each pair at most once
  std::span<const int> num_features;      ///< one a view
  std::span<const std::string> warnings;  ///< one line each, UTF-8
  std::string title = "Connections";      ///< of drawing and page, UTF-8
};

/// The cameras seen from above as an SVG drawing, true to scale: one user unit is one millimetre on
/// paper, north is where the world's y axis points. The sheet is as wide as A4 is long and as high
/// as it must be.
///
/// One panel for every component of at least two views, then one that lists the pictures that
/// nothing ties to others. Points are shown by their density; lines between cameras are the pairs
/// that tie them (width grows with the square root of the inliers), dashed red lines are pairs that
/// were refused because they contradict the others: the 40 with most inliers, between two
/// components only the best. Names are shortened to what tells them apart and left out where there
/// is no space; all cameras and lines have their full names as tooltips.
///
/// Classes: circle.camera (data-picture, data-component), line.tie and line.refused (data-a,
/// data-b, data-inliers), path.points. Positions must be finite, indices of pairs in range
/// (std::logic_error). Same input, same bytes. Cost: O(pairs · views) for the lettering.
[[nodiscard]] std::string FormatConnectionsSvg(const Scene& scene, const ConnectionReport& report);

/// The drawing in a web page that needs no other file and no script, with tables of all views and
/// of the pairs: what was refused, why, and what the user can do. Of the refused pairs the 200 that
/// have most in common are shown. The page is also well-formed XML.
[[nodiscard]] std::string FormatConnectionsHtml(const Scene& scene, const ConnectionReport& report);

/// Writes connections.json, connections.svg and connections.html (docs/formats-output.md) into
/// `folder`, which is made if need be; each file atomically. Throws IoError.
void WriteConnectionReport(const std::filesystem::path& folder, const Scene& scene,
                           const ConnectionReport& report);

}  // namespace enfilade
