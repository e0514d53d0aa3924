// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "enfilade/model/types.h"

namespace enfilade {

/// "floor", "ceiling", "wall_<id>", or "wall_f<face_idx>" for a wall that the plan does not list.
[[nodiscard]] std::string SurfaceName(const ModelFace& face, size_t face_idx);

}  // namespace enfilade
