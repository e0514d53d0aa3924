// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/evidence/types.h"
#include "enfilade/pipeline/options.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// The evidence of all storeys, cores included.
struct GatheredEvidence {
  std::vector<EvidenceGrids> storeys;
  int num_cores = 0;   ///< in all storeys
  std::string reason;  ///< why there are no grids, one line; empty when there are
};

/// What the floorplan works with in a mode.
[[nodiscard]] EvidenceMode EvidenceModeOf(FloorplanMode mode);

/// From wall profiles and the scene's points to grids and core free space, storey by storey: what
/// the stage `evidence` writes, or what a method that wants the other mode gathers from the same
/// structure. Reads no pictures. Throws what AccumulateEvidence throws.
[[nodiscard]] GatheredEvidence EvidenceOf(const Scene& scene, const Structure& structure,
                                          const EvidenceOptions& options, EvidenceMode mode,
                                          RunContext& context);

}  // namespace enfilade
