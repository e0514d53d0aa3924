// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/evidence/accumulate.h"
#include "polar_view.h"

namespace enfilade {

/// The views with what their sum needs.
struct ViewEvidence {
  const AccumulateOptions& options;
  std::vector<PolarView> views;
  std::vector<double> weights;  ///< of the views
  float far_m = 0;              ///< nothing is said beyond
};

/// Views closer than same_place_m err together (same pose error, same furniture in the way), so
/// they share a vote: the weight of a view is 1/Σ max(0, 1 − distance/same_place_m) over all views.
[[nodiscard]] std::vector<double> WeightsByPlace(const std::vector<PolarView>& views,
                                                 double same_place_m);

/// Sets wall, free and support of every cell to what all views say together.
void AccumulateViews(const ViewEvidence& evidence, EvidenceGrids& grids, RunContext& context);

/// Takes trust from columns beyond the place where the other views say that they ran through a
/// wall: the view out of a window that the others see as wall, a mirror, a missed wall.
///
/// Along each column, L is the free evidence in `grids` less the view's own, averaged over 5 cm;
/// the trust beyond a place with L < 0 falls as 2/(1 + e^(−L−½)). Own evidence is taken off at full
/// weight, so that duplicates of a view do not vouch for it.
void DistrustContradictedColumns(const EvidenceGrids& grids, ViewEvidence& evidence,
                                 RunContext& context);

}  // namespace enfilade
