// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "src/synthetic/furniture.h"

namespace enfilade {

struct KitchenRunSize {
  double width_m = 2.0;
  double wall_cabinets_top_m = 2.05;
  double soffit_top_m = 0;  ///< the wall comes forward above the wall cabinets up to here; 0: not
};

/// Base cabinets with a worktop, and wall cabinets above.
[[nodiscard]] FurniturePiece KitchenRun(const KitchenRunSize& size, Random& random);

/// What a room keeps when the furniture is gone, most wanted first: kitchen runs and a fridge; tub,
/// basin and toilet; a closet's shelf; and with `has_cabinets_to_ceiling` such cabinets.
[[nodiscard]] std::vector<FurniturePiece> BuiltInsFor(const HomeRoom& room,
                                                      bool has_cabinets_to_ceiling, Random& random);

}  // namespace enfilade
