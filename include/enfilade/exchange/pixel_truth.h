// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "enfilade/image/image.h"

namespace enfilade {

/// What a pixel shows, structurally: closed door leaves, windows, frames and baseboards are wall.
enum class SurfaceLabel : uint8_t { kOther, kFloor, kWall, kCeiling };
[[nodiscard]] std::span<const std::string_view> EnumNames(SurfaceLabel);

/// The truth about every pixel of an equirectangular panorama (docs/formats.md), one file at a time
/// as a TruthView names it. All are twice as wide as high. They throw IoError, and
/// InvalidInputError for a broken file, another shape or type, or values that cannot be.

/// Rows × cols of SurfaceLabel.
[[nodiscard]] ImageU8 ReadTruthLabels(const std::filesystem::path& path);
/// Rows × cols: metres along the ray, 0 where there is none.
[[nodiscard]] ImageF ReadTruthDepth(const std::filesystem::path& path);
/// Rows × cols × 3: 127 times the unit normal in the truth's world, 0 where there is none.
[[nodiscard]] Image<int8_t> ReadTruthNormals(const std::filesystem::path& path);

}  // namespace enfilade
