// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>

#include "enfilade/scene/types.h"

namespace enfilade {

/// Writes points as a binary little-endian PLY, atomically: x y z (float), nx ny nz (float) where
/// any point has a normal, red green blue (uchar), in the world of the scene, metres, z up. Throws
/// IoError.
void WritePointsPly(const std::filesystem::path& path, std::span<const ScenePoint> points);

/// Writes cameras as a mesh in a binary little-endian PLY, atomically, in the world of the scene,
/// metres, z up: x y z (float), red green blue (uchar) and triangles. Each camera is a pyramid with
/// its tip at the camera's centre and its base `length_m` in front of it, 1.5 times as wide as
/// high, with a triangle on the edge that is up: seven triangles with vertices of their own.
/// Panoramas are blue, other pictures orange, tips white. Throws IoError. `length_m` must be
/// positive (std::logic_error).
void WriteCamerasPly(const std::filesystem::path& path, std::span<const View> views,
                     double length_m = 0.2);

}  // namespace enfilade
