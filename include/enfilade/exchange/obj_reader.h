// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "enfilade/model/types.h"

namespace enfilade {

/// Reads the faces of a model that WriteObj wrote, in their order, with the vertices that each face
/// uses and its normal; textures are not read, and walls that the plan does not list have the wall
/// id −1. Throws IoError, and InvalidInputError for a file that is cut or broken, or whose groups
/// are not those of a model.
[[nodiscard]] BuildingModel ReadObj(const std::filesystem::path& path);

}  // namespace enfilade
