// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/evidence/types.h"
#include "enfilade/floorplan/paper.h"
#include "enfilade/image/image.h"
#include "enfilade/optim/grid_loop.h"
#include "src/floorplan/paper_field.h"

namespace enfilade {

/// A vertex on a wall face, with its place in the order of the loop.
struct WallAnchor {
  GridVertex vertex;
  GridHeading heading = GridHeading::kEast;  ///< along the wall, free space on the left
  float points = 0;                          ///< evidence
  double support_m = 0;                      ///< length of wall seen on its line
  size_t contour_idx = 0;  ///< of the contour's vertex straight before or behind it
};

/// Where anchors are looked for.
struct AnchorScene {
  const PaperField& field;
  const std::vector<EvidenceCamera>& cameras;
  const ImageU8& core;
  const ImageU8& inside_first;             ///< cells that the first path encloses
  const ImageU8& foreign;                  ///< cells of other cores
  const std::vector<GridVertex>& contour;  ///< TraceContour of the closed free space
};

/// Wall faces that the second path has to pass, ascending contour_idx, all different: local maxima
/// of wall evidence on aligned support, on the first path or outside of it, that some camera sees;
/// the strongest first, no other within anchor_spacing_m of it unless it faces the other way.
[[nodiscard]] std::vector<WallAnchor> FindAnchors(const AnchorScene& scene,
                                                  const PaperOptions& options);

/// Leaves out, the worst first, anchors whose removal lowers the cost of the legs to their
/// neighbours by more than three corners and their support: clutter and reflections.
[[nodiscard]] std::vector<WallAnchor> ValidateAnchors(const AnchorScene& scene,
                                                      const std::vector<WallAnchor>& anchors);

/// The contour with a detour to every anchor and back, as corners. `anchor_idx` gets the anchors'
/// places in it.
[[nodiscard]] std::vector<GridVertex> MakeGuide(const std::vector<GridVertex>& contour,
                                                const std::vector<WallAnchor>& anchors,
                                                std::vector<int>& anchor_idx);

}  // namespace enfilade
