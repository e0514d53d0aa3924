// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace enfilade {

/// SHA-256 as 64 lower-case hexadecimal digits (FIPS 180-4).
[[nodiscard]] std::string Sha256(std::string_view bytes);

/// SHA-256 of a file's content, read in blocks. Throws IoError when it cannot be read.
[[nodiscard]] std::string Sha256OfFile(const std::filesystem::path& path);

}  // namespace enfilade
