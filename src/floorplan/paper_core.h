// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/evidence/types.h"
#include "enfilade/image/image.h"
#include "src/floorplan/paper_field.h"

namespace enfilade {

/// The cores, those made one, with the cells between, that a ray from camera to camera joins: the
/// paper has one loop round all of them. `cores` are 4-connected sets of cells and stay so.
[[nodiscard]] std::vector<ImageU8> BridgeCores(const PaperField& field,
                                               const std::vector<EvidenceCamera>& cameras,
                                               const std::vector<ImageU8>& cores);

/// Free space of at least hidden_m2 that lies wholly outside the loop, such as a room behind a
/// door, becomes core, with a way to it through free space. `inside` are the cells that the loop
/// encloses, `foreign` those of other cores. Returns the number of such spaces.
int AddHiddenSpace(const PaperField& field, const ImageU8& inside, const ImageU8& foreign,
                   double hidden_m2, ImageU8& core);

}  // namespace enfilade
