// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "enfilade/image/image.h"

namespace enfilade {

/// Writes an image as a NumPy array file (format 1.0, C order, little endian): rows × cols, or
/// rows × cols × channels when there are several. Atomic; throws IoError.
void WriteNpy(const std::filesystem::path& path, const Image<float>& image);
void WriteNpy(const std::filesystem::path& path, const Image<int16_t>& image);
void WriteNpy(const std::filesystem::path& path, const Image<int8_t>& image);

}  // namespace enfilade
