// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "enfilade/base/file.h"

namespace enfilade {

inline constexpr std::string_view kJpegStart = "\xFF\xD8";
inline constexpr std::string_view kPngStart = "\x89PNG\r\n\x1A\n";

/// Big-endian numbers of picture headers; the bytes must be there.
[[nodiscard]] inline int BigEndian16(std::string_view bytes, size_t i) {
  return static_cast<uint8_t>(bytes[i]) << 8 | static_cast<uint8_t>(bytes[i + 1]);
}
[[nodiscard]] inline uint32_t BigEndian32(std::string_view bytes, size_t i) {
  return static_cast<uint32_t>(BigEndian16(bytes, i)) << 16 |
         static_cast<uint32_t>(BigEndian16(bytes, i + 2));
}

/// A marker segment of a JPEG file.
struct JpegSegment {
  uint8_t marker = 0;
  uint64_t offset = 0;  ///< of the marker in the file
  int length = 0;       ///< of what follows the marker, the two bytes of the length included
};

/// Visits the marker segments up to the start of the scan (ITU T.81, B.2.2 and B.2.3) until `visit`
/// returns false. Returns the offset of the start of the scan, 0 where it was not reached.
[[nodiscard]] uint64_t WalkJpegSegments(const FileReader& file,
                                        const std::function<bool(const JpegSegment&)>& visit);

}  // namespace enfilade
