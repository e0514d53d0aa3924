// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include <nlohmann/json_fwd.hpp>

#include "enfilade/floorplan/types.h"

namespace enfilade {

/// Writes floorplan.json (docs/formats.md), atomically. Lengths are rounded to 1 µm and rotations
/// to 1e-9, so that the same plan gives the same bytes and the file reads well.
///
/// `provenance` is an object that stands in the file under that key: the program's version and the
/// options that influence the result. It must hold no time, path or thread count.
///
/// Throws IoError. Requires finite numbers.
void WriteFloorplanJson(const std::filesystem::path& path, const Floorplan& floorplan,
                        const nlohmann::json& provenance);

/// Reads floorplan.json, also one of another program that holds only what docs/formats.md requires.
///
/// Guarantees: outer rings are counter-clockwise and holes clockwise, with at least three vertices;
/// numbers are finite; rotations orthonormal; what walls, openings and cameras refer to exists.
/// Throws IoError, and InvalidInputError for another format or version, a missing key, a wrong type
/// or a reference to nothing.
[[nodiscard]] Floorplan ReadFloorplanJson(const std::filesystem::path& path);

}  // namespace enfilade
