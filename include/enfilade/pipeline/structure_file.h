// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "enfilade/structure/types.h"

namespace enfilade {

/// Writes `folder`/structure.json and one profile_NNNN.bin a panorama.
///
/// Numbers come back exactly as they were written: JSON holds doubles in shortest form that reads
/// back the same, arrays are little-endian binary with magic, version and sizes (docs/formats.md).
/// The index is written last, so what has one is whole.
void WriteStructure(const std::filesystem::path& folder, const Structure& structure);

/// Throws IoError when a file is missing or unreadable, and InvalidInputError when it is truncated,
/// too long, of another format or version, or holds NaN.
[[nodiscard]] Structure ReadStructure(const std::filesystem::path& folder);

}  // namespace enfilade
