// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/geometry/rigid3.h"
#include "enfilade/sfm/types.h"

namespace enfilade {

/// Decides which accepted pairs hold. Rooms of one home look alike: two baths, or doors and
/// wardrobes of one make, agree far better than unrelated pictures do by chance. So the pairs that
/// nothing but the same place explains come first, and make groups of views with positions
/// (AverageYaws, SolvePositions). A weaker pair within a group must agree with these positions.
/// Between two groups, weaker pairs that tell the same place of one beside the other count
/// together; the groups are joined, clearest first, where their chances multiply to less than 10 to
/// the power of −20 (−45 where that puts two panoramas nearer than 1.2 camera heights, which then
/// ought to have much more in common) and no other place has more than half as many digits.
///
/// Expects lengths where floor, ceiling or shared features tell them. What does not hold gets the
/// verdict kAgainstTriplets, kAgainstPositions or, between groups, kChance.
void AssembleGroups(int num_views, std::vector<PanoPair>& pairs);

/// Whether a pair tells the place of its b in a's level frame (camera heights): to 3° and a fifth
/// of a camera height or an eighth of the length or, where the length is not known, to 8°.
[[nodiscard]] bool TellsPlace(const PanoPair& pair, const Rigid3& a_from_b);

}  // namespace enfilade
