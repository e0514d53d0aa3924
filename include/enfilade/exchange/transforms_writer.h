// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "enfilade/scene/types.h"

namespace enfilade {

/// Writes a scene's views as transforms.json of Nerfstudio, atomically: camera_model, w, h, fl_x,
/// fl_y, cx, cy for the file where all cameras are the same, else for every frame; per frame
/// file_path and mask_path, relative to the file's folder, and transform_matrix, camera to world,
/// metres, z up, with OpenGL's camera axes (x right, y up, z back). Panoramas are EQUIRECTANGULAR,
/// with fl_x = fl_y = w / 2 and the centre as Nerfstudio wants them, others PINHOLE. Nerfstudio
/// itself reads camera_model for the whole file only.
///
/// Views without a path are called `picture`. Folders whose name is no UTF-8 cannot stand in the
/// file; such pictures have to lie beside it. Read back, poses are the same to 1e-12. Throws
/// IoError.
void WriteTransforms(const std::filesystem::path& path, const Scene& scene);

}  // namespace enfilade
