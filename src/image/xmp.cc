// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/image/xmp.h"

#include <string_view>

#include "enfilade/base/file.h"
#include "src/image/jpeg_segments.h"

namespace enfilade {
namespace {

constexpr size_t kMaxPacketBytes = size_t{1} << 16;

std::string PacketOfJpeg(const FileReader& file) {
  constexpr uint8_t kApp1 = 0xE1;
  constexpr std::string_view kName("http://ns.adobe.com/xap/1.0/\0", 29);
  std::string packet;
  static_cast<void>(WalkJpegSegments(file, [&](const JpegSegment& segment) {
    const int num_bytes = segment.length - 2 - static_cast<int>(kName.size());
    if (segment.marker != kApp1 || num_bytes <= 0) return true;
    const uint64_t begin = segment.offset + 4;
    if (file.ReadAt(begin, kName.size()) != kName) return true;
    packet = file.ReadAt(begin + kName.size(), static_cast<size_t>(num_bytes));
    return false;
  }));
  return packet;
}

// The text of an iTXt chunk: keyword, 0, compressed?, method, language, 0, translated keyword, 0,
// text (ISO 15948, 11.3.4.5).
std::string TextOfChunk(const std::string& chunk) {
  constexpr std::string_view kKeyword("XML:com.adobe.xmp\0", 18);
  if (!chunk.starts_with(kKeyword) || chunk.size() < kKeyword.size() + 2) return {};
  const bool is_compressed = chunk[kKeyword.size()] != 0;
  const size_t language_end = chunk.find('\0', kKeyword.size() + 2);
  if (is_compressed || language_end == std::string::npos) return {};
  const size_t translated_end = chunk.find('\0', language_end + 1);
  return translated_end == std::string::npos ? std::string() : chunk.substr(translated_end + 1);
}

std::string PacketOfPng(const FileReader& file) {
  constexpr uint64_t kLengthAndType = 8, kChecksum = 4;
  for (uint64_t offset = kPngStart.size();;) {
    const std::string head = file.ReadAt(offset, kLengthAndType);
    if (head.size() < kLengthAndType || head.ends_with("IEND")) return {};
    const uint32_t num_bytes = BigEndian32(head, 0);
    if (head.ends_with("iTXt") && num_bytes <= kMaxPacketBytes) {
      const std::string text = TextOfChunk(file.ReadAt(offset + kLengthAndType, num_bytes));
      if (!text.empty()) return text;
    }
    offset += kLengthAndType + num_bytes + kChecksum;
  }
}

}  // namespace

std::string ReadXmpPacket(const std::filesystem::path& path) {
  const FileReader file(path);
  const std::string start = file.ReadAt(0, kPngStart.size());
  if (start.starts_with(kJpegStart)) return PacketOfJpeg(file);
  if (start == kPngStart) return PacketOfPng(file);
  return {};
}

}  // namespace enfilade
