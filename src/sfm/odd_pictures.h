// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/sfm/register.h"
#include "enfilade/sfm/types.h"

namespace enfilade {

/// A panorama that agrees with another one once it is turned over or mirrored.
struct OddTie {
  int view_idx = 0;
  int partner_idx = 0;
  double log10_chance = 0;
};

/// A panorama as it is compared.
struct PanoTrial {
  PanoFeatures features;
  Gravity gravity;
};

/// What would be found if the panorama stood upside down: half a turn about its viewing direction.
[[nodiscard]] PanoTrial TurnedOver(const PanoFeatures& features, const Gravity& gravity);

/// What would be found in the mirrored picture (left and right exchanged).
[[nodiscard]] PanoTrial Mirrored(const PanoFeatures& features, const Gravity& gravity);

/// Finds panoramas that stand upside down beside the others: every component but the first is
/// turned over and compared with those of lower index. Where a pair then agrees far better than
/// chance allows (EstimatePair), the whole component is turned over in `features` and `gravity`,
/// and the tie is returned: registration is to be done again.
///
/// Of two components of equal size the second is turned over, although it may be the first that
/// stands upside down. Cost: matching of all panoramas outside the largest component with the rest.
[[nodiscard]] std::vector<OddTie> TurnOverTheUpsideDown(std::span<const int> component_idx,
                                                        const RegisterOptions& options,
                                                        RunContext& context,
                                                        std::vector<PanoFeatures>& features,
                                                        std::vector<Gravity>& gravity);

/// Likewise panoramas, one a component, that agree with others once they are mirrored. Tried are
/// single panoramas and components at most a third as large as the largest.
[[nodiscard]] std::vector<OddTie> FindMirrored(std::span<const PanoFeatures> features,
                                               std::span<const Gravity> gravity,
                                               std::span<const int> component_idx,
                                               const RegisterOptions& options, RunContext& context);

/// Pairs that were taken from one place and have most of their features in common: copies of one
/// picture in other files.
[[nodiscard]] std::vector<OddTie> FindCopies(std::span<const PanoFeatures> features,
                                             std::span<const Gravity> gravity,
                                             std::span<const PanoPair> pairs);

}  // namespace enfilade
