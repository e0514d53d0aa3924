// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "enfilade/evidence/types.h"

namespace enfilade {

/// Writes `folder`/evidence.json and, for each storey, storey_N.bin and the pictures
/// storey_N_wall.png, _free.png and _core.png for people (y up).
///
/// Numbers come back exactly as they were written: JSON holds doubles in shortest form that reads
/// back the same, arrays are little-endian binary with magic, version and sizes (docs/formats.md).
/// The index is written last, so what has one is whole.
void WriteEvidence(const std::filesystem::path& folder, const std::vector<EvidenceGrids>& storeys);

/// Throws IoError when a file is missing or unreadable, and InvalidInputError when it is truncated,
/// too long, of another format or version, or holds NaN.
[[nodiscard]] std::vector<EvidenceGrids> ReadEvidence(const std::filesystem::path& folder);

}  // namespace enfilade
