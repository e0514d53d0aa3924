// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/base/errors.h"

#include <cstdint>
#include <string_view>

namespace enfilade {
namespace {

// Length of the well-formed UTF-8 sequence at the start of `bytes`, 0 when there is none
// (RFC 3629: no overlong forms, no surrogates, nothing above U+10FFFF).
size_t Utf8SequenceLength(std::string_view bytes) {
  const auto byte = [&](size_t i) { return static_cast<uint8_t>(bytes[i]); };
  const uint8_t lead = byte(0);
  if (lead < 0x80) return 1;
  const size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : lead >= 0xC2 ? 2 : 0;
  if (length == 0 || lead > 0xF4 || bytes.size() < length) return 0;
  for (size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  const uint8_t second = byte(1);
  if ((lead == 0xE0 && second < 0xA0) || (lead == 0xED && second > 0x9F) ||
      (lead == 0xF0 && second < 0x90) || (lead == 0xF4 && second > 0x8F)) {
    return 0;
  }
  return length;
}

std::string Printable(std::string_view bytes) {
  static constexpr char kHex[] = "0123456789abcdef";
  std::string printable;
  while (!bytes.empty()) {
    const size_t length = Utf8SequenceLength(bytes);
    const uint8_t lead = static_cast<uint8_t>(bytes[0]);
    if (length == 0 || lead < 0x20 || lead == 0x7F) {
      printable += {'\\', 'x', kHex[lead >> 4], kHex[lead & 15]};
      bytes.remove_prefix(1);
    } else {
      printable += bytes.substr(0, length);
      bytes.remove_prefix(length);
    }
  }
  return printable;
}

}  // namespace

UserError::UserError(const std::string& where, const std::string& problem, const std::string& cure)
    : std::runtime_error(Printable(where) + ": " + Printable(problem) +
                         (cure.empty() ? "" : "; " + Printable(cure))) {}

std::string PrintablePath(const std::filesystem::path& path) { return Printable(path.native()); }

bool IsValidUtf8(std::string_view bytes) {
  while (!bytes.empty()) {
    const size_t length = Utf8SequenceLength(bytes);
    if (length == 0) return false;
    bytes.remove_prefix(length);
  }
  return true;
}

}  // namespace enfilade
