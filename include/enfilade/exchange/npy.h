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

/// Reads a NumPy array file (format 1.0 to 3.0, C order, little endian) of two axes, or of three
/// with the channels last. T is float, int16_t or int8_t and must be the file's type. Throws
/// IoError, and InvalidInputError for another type or shape, more than 2^28 values or a file that
/// is shorter or longer than its header says.
template <typename T>
[[nodiscard]] Image<T> ReadNpy(const std::filesystem::path& path);

}  // namespace enfilade
