// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "src/baselines/voxel_frame.h"

namespace enfilade {

/// Sets voxels (1 inside, 0 outside) until the border of the inside is a surface without seams:
/// no two voxels of one side touch at an edge or a corner alone, and no two of the border's faces
/// in one plane touch at a corner alone. Then the outlines of faces in a plane are simple rings.
/// What is set stays within the bounding box of the inside. Cost O(voxels) a pass, few passes.
void JoinVoxels(const VoxelFrame& frame, std::vector<uint8_t>& inside);

}  // namespace enfilade
