// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace enfilade {

/// The way from `folder` to `file`; empty for an empty `file`. Folders are resolved so that the way
/// between them holds even through links; the file itself keeps its name.
[[nodiscard]] std::filesystem::path RelativePath(const std::filesystem::path& file,
                                                 const std::filesystem::path& folder);

}  // namespace enfilade
