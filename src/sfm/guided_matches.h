// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "enfilade/base/run_context.h"
#include "enfilade/sfm/register.h"

namespace enfilade {

/// Matches panoramas of one component once more, now that poses tell where a match may lie.
///
/// A looser ratio test gives more matches; those count whose rays miss a common plane with the
/// known baseline by at most `guided_deg` and meet in front of both cameras at a parallax of 1.5°.
/// Of a pair they are taken only when they are at least four times as many as among shifted
/// matches, so that at most a fifth is false. Pairs that were not accepted are accepted then.
///
/// Pairs are taken up to `guided_reach` camera heights apart. Cost: as the first matching of them.
void MatchGuided(std::span<const PanoFeatures> features, std::span<const Gravity> gravity,
                 const RegisterOptions& options, RunContext& context, Registration& registration);

}  // namespace enfilade
