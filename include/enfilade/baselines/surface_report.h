// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "enfilade/floorplan/types.h"
#include "enfilade/model/types.h"

namespace enfilade {

enum class SurfaceOutcome { kFound, kNoSurface };
[[nodiscard]] std::span<const std::string_view> EnumNames(SurfaceOutcome);

/// What a rival in three dimensions makes of the home.
struct SurfaceReport {
  SurfaceOutcome outcome = SurfaceOutcome::kNoSurface;
  std::string reason;   ///< one line; empty when there is a surface
  BuildingModel model;  ///< home frame, without textures; each face a planar piece
  /// The parts of the level section of the inside that hold a camera, storey by storey, cut at the
  /// median height of its cameras.
  Floorplan plan;
};

}  // namespace enfilade
