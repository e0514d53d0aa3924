// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "enfilade/image/image.h"
#include "enfilade/scene/surface_label.h"

namespace enfilade {

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
