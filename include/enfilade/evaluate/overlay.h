// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "enfilade/base/options.h"
#include "enfilade/evaluate/evaluate.h"

namespace enfilade {

struct OverlayOptions {
  int longest_side_px = 1100;  ///< of the drawing without its legend
  bool draw_profiles = false;  ///< the wall profile of every panorama

  void Visit(OptionVisitor& v);
};

/// A picture of plan and truth on one another in the truth's world, x to the right, y up: true
/// rooms pale, what the plan misses and what it has too much in colours, true walls, plan walls,
/// doors, cameras coloured by their columns within 10 %, scale bar, legend and key figures. `input`
/// and `report` as given to and got from Evaluate; what is null is not drawn.
[[nodiscard]] std::string RenderOverlaySvg(const EvaluationInput& input, const GroundTruth& truth,
                                           const EvaluationReport& report,
                                           const OverlayOptions& options = {});

/// The same as the bytes of a PNG file.
[[nodiscard]] std::string RenderOverlayPng(const EvaluationInput& input, const GroundTruth& truth,
                                           const EvaluationReport& report,
                                           const OverlayOptions& options = {});

}  // namespace enfilade
