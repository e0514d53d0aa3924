// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace enfilade {

/// The XMP packet (XML text, at most 64 KiB) of a JPEG (its first APP1 segment of that kind) or a
/// PNG (an uncompressed iTXt chunk), as XMP part 3 (ISO 16684-1, annex on embedding) says; empty
/// when there is none or the file's structure is broken before it. Reads headers only. Throws
/// IoError when the file cannot be read.
[[nodiscard]] std::string ReadXmpPacket(const std::filesystem::path& path);

}  // namespace enfilade
