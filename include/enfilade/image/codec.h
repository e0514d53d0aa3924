// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "enfilade/image/image.h"

namespace enfilade {

struct ImageSize {
  int width = 0;
  int height = 0;
};

/// Size of a JPEG or PNG from its header: reads a few blocks of the file, decodes nothing. Throws
/// IoError, or InvalidInputError when it is neither, truncated before the size or said to have more
/// than 2^28 pixels.
[[nodiscard]] ImageSize ReadImageSize(const std::filesystem::path& path);

/// Decodes a picture (JPEG, PNG, TIFF, WebP; EXIF orientation is ignored, as poses refer to the
/// stored pixels) to 8-bit RGB, rows × cols × 3; transparency is dropped. Throws IoError or
/// InvalidInputError (truncated, no picture, more than 2^28 pixels).
[[nodiscard]] ImageU8 ReadImageRgb(const std::filesystem::path& path);

/// As above for masks: rows × cols × 1.
[[nodiscard]] ImageU8 ReadImageGray(const std::filesystem::path& path);

/// Writes 1- or 3-channel (RGB) 8-bit PNG or JPEG by extension (.png, .jpg, .jpeg), atomically.
/// Throws IoError.
void WriteImage(const std::filesystem::path& path, const ImageU8& image, int jpeg_quality = 92);

/// The encoded bytes; `extension` is ".png" or ".jpg". Same input, same bytes.
[[nodiscard]] std::string EncodeImage(const ImageU8& image, std::string_view extension,
                                      int jpeg_quality = 92);

}  // namespace enfilade
