// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace enfilade {

/// The root of the checkout that the tests were built from.
[[nodiscard]] std::filesystem::path SourceFolder();

}  // namespace enfilade
