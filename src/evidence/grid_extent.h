// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/evidence/accumulate.h"

namespace enfilade {

/// The frame that holds every camera, every wall point up to max_range_m and a margin, aligned to
/// whole cells. Throws InvalidInputError when it would be too large. Requires a camera.
[[nodiscard]] GridFrame FrameOfEvidence(const WallSampleSet& samples,
                                        const std::vector<EvidenceCamera>& cameras,
                                        const AccumulateOptions& options,
                                        const RunContext& context);

}  // namespace enfilade
