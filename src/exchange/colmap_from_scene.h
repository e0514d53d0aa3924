// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/exchange/colmap_writer.h"
#include "src/exchange/colmap_model.h"

namespace enfilade {

/// The model that WriteColmapModel writes, with the same requirements.
[[nodiscard]] ColmapModel ColmapFromScene(const Scene& scene, ColmapForm form);

}  // namespace enfilade
