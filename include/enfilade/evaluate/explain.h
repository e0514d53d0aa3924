// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "enfilade/evidence/types.h"
#include "enfilade/exchange/ground_truth.h"
#include "enfilade/floorplan/paper.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/geometry/rigid3.h"

namespace enfilade {

/// What a floorplan came from, and how. Evidence has an entry a storey; `paper` too, or none when
/// the plan was not made by the paper's method.
struct ExplainInput {
  const Floorplan& floorplan;
  const std::vector<EvidenceGrids>& evidence;
  const std::vector<PaperStorey>& paper;
  const GroundTruth* truth = nullptr;  ///< may be null
  Rigid3 home_from_truth;
};

/// A page of panels of one scale, a row or more a storey: wall evidence and free-space evidence
/// (blue, green, red: low, medium, high), core free space with the cameras, and for the paper's
/// method the start and end line with the first path, the anchors on the contour that orders them,
/// and the second path; else the plan. With truth also the true rooms.
[[nodiscard]] std::string RenderExplainSvg(const ExplainInput& input);

/// The same as the bytes of a PNG file.
[[nodiscard]] std::string RenderExplainPng(const ExplainInput& input);

}  // namespace enfilade
