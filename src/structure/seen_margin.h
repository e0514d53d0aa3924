// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/structure/level_panorama.h"

namespace enfilade {

/// 1 where all pixels of the panorama within `margin_px` rows and columns are seen, else 0: where a
/// filter of that reach owes nothing to unseen pixels. Wraps round in azimuth.
[[nodiscard]] ImageU8 SeenWithMargin(const LevelPanorama& panorama, int margin_px);

}  // namespace enfilade
