// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "enfilade/scene/types.h"

namespace enfilade {

/// Hash of everything in a scene but the places of its files, which may move; masks count by their
/// content. Throws IoError when a mask cannot be read.
[[nodiscard]] std::string SceneHash(const Scene& scene);

}  // namespace enfilade
