// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace enfilade {

/// What a pixel or a point is, structurally: closed door leaves, windows, frames and baseboards are
/// wall; furniture and all that is unknown is other.
enum class SurfaceLabel : uint8_t { kOther, kFloor, kWall, kCeiling };
[[nodiscard]] std::span<const std::string_view> EnumNames(SurfaceLabel);

}  // namespace enfilade
