// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "enfilade/scene/types.h"

namespace enfilade {

/// Writes a scene as JSON, atomically: the artefact that later stages start from. Numbers are kept
/// exactly. Paths of pictures and masks are relative to the file's folder; bytes of theirs that are
/// no UTF-8 stand as %NN. Throws IoError.
void WriteSceneJson(const std::filesystem::path& path, const Scene& scene);

/// Reads what WriteSceneJson wrote: ReadSceneJson(p) after WriteSceneJson(p, s) equals s but for
/// paths, which name the same files. Throws IoError, and InvalidInputError for another format or
/// version, a missing key, a wrong type or a number that is not finite.
[[nodiscard]] Scene ReadSceneJson(const std::filesystem::path& path);

}  // namespace enfilade
