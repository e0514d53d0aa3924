// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/surface_name.h"

namespace enfilade {

std::string SurfaceName(const ModelFace& face, size_t face_idx) {
  if (face.kind == SurfaceKind::kFloor) return "floor";
  if (face.kind == SurfaceKind::kCeiling) return "ceiling";
  return face.wall_id >= 0 ? "wall_" + std::to_string(face.wall_id)
                           : "wall_f" + std::to_string(face_idx);
}

}  // namespace enfilade
