// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>

#include "enfilade/scene/types.h"
#include "enfilade/synthetic/home.h"

namespace enfilade {

/// Writes points of a home (FixturePoints, `view_idx` counts home.cameras) as other programs would,
/// in the world and with the poses that transforms.json claims:
///
///   dense/fused.ply, fused.ply.vis         COLMAP's stereo_fusion
///   dense/sparse/                          the COLMAP model whose images these count
///   pmvs/models/option-0000.patch, .ply    PMVS2
///   pmvs/bundle.rd.out.list.txt            the images that these count
///
/// The positions and normals of both are the same numbers, of single precision. Each file is
/// written atomically. Throws IoError.
void WriteClouds(const std::filesystem::path& folder, const Home& home,
                 std::span<const ScenePoint> points);

/// Removes what WriteClouds wrote, where it is there. Throws IoError.
void RemoveClouds(const std::filesystem::path& folder);

}  // namespace enfilade
