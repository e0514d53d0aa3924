// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>

#include "enfilade/scene/types.h"

namespace enfilade {

/// Writes points as a binary little-endian PLY, atomically: x y z nx ny nz (float), red green blue
/// (uchar), in the world of the scene, metres, z up. Throws IoError.
void WritePointsPly(const std::filesystem::path& path, std::span<const ScenePoint> points);

}  // namespace enfilade
