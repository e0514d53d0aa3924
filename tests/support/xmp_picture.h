// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace enfilade {

/// The bytes of a JPEG with an XMP packet put in.
inline std::string JpegWithXmp(const std::string& jpeg, const std::string& packet) {
  const std::string content = std::string("http://ns.adobe.com/xap/1.0/\0", 29) + packet;
  const size_t length = content.size() + 2;
  return jpeg.substr(0, 2) + "\xFF\xE1" + static_cast<char>(length >> 8) +
         static_cast<char>(length & 255) + content + jpeg.substr(2);
}

inline std::string BigEndian(uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
  return bytes;
}

/// A PNG chunk; the checksum is that of ISO 15948, annex D.
inline std::string PngChunk(const std::string& type, const std::string& content) {
  const std::string body = type + content;
  uint32_t crc = 0xFFFFFFFF;
  for (const char c : body) {
    crc ^= static_cast<uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xEDB88320 : 0);
  }
  return BigEndian(static_cast<uint32_t>(content.size())) + body + BigEndian(~crc);
}

/// The bytes of a PNG with an XMP packet put in behind the header chunk.
inline std::string PngWithXmp(const std::string& png, const std::string& packet) {
  constexpr size_t kHeaderEnd = 33;
  const std::string content = std::string("XML:com.adobe.xmp\0\0\0\0\0", 22) + packet;
  return png.substr(0, kHeaderEnd) + PngChunk("iTXt", content) + png.substr(kHeaderEnd);
}

/// An XMP packet with GPano attributes, as in R"(GPano:PosePitchDegrees="2")".
inline std::string GPanoPacket(const std::string& attributes) {
  return R"(<?xpacket begin="" id="W5M0MpCehiHzreSzNTczkc9d"?><x:xmpmeta xmlns:x="adobe:ns:meta/">)"
         R"(<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#"><rdf:Description )"
         R"(rdf:about="" xmlns:GPano="http://ns.google.com/photos/1.0/panorama/" )" +
         attributes + R"(/></rdf:RDF></x:xmpmeta><?xpacket end="w"?>)";
}

}  // namespace enfilade
