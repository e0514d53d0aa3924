// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/image/jpeg_segments.h"

#include <string>

namespace enfilade {
namespace {

bool IsStandaloneMarker(uint8_t marker) {
  return marker == 0x01 || (marker >= 0xD0 && marker <= 0xD7);
}

}  // namespace

uint64_t WalkJpegSegments(const FileReader& file,
                          const std::function<bool(const JpegSegment&)>& visit) {
  constexpr uint8_t kStartOfScan = 0xDA, kStartOfImage = 0xD8, kEndOfImage = 0xD9;
  for (uint64_t offset = kJpegStart.size();;) {
    const std::string bytes = file.ReadAt(offset, 4);
    if (bytes.size() < 4 || static_cast<uint8_t>(bytes[0]) != 0xFF) return 0;
    const uint8_t marker = static_cast<uint8_t>(bytes[1]);
    if (marker == kStartOfScan) return offset;
    if (marker == kStartOfImage || marker == kEndOfImage) return 0;
    if (marker == 0xFF) {
      offset += 1;  // fill byte
    } else if (IsStandaloneMarker(marker)) {
      offset += 2;
    } else {
      const JpegSegment segment{marker, offset, BigEndian16(bytes, 2)};
      if (!visit(segment)) return 0;
      offset += 2 + static_cast<uint64_t>(segment.length);
    }
  }
}

}  // namespace enfilade
