// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

namespace enfilade {

/// Names for lettering: without the beginning and the end that all have in common, and with "…" for
/// the beginning, the end or the middle of what is still long. Numbers are not cut apart. Different
/// names (UTF-8) stay different; a name that no cut tells from the others is kept whole.
[[nodiscard]] std::vector<std::string> ShortNames(std::span<const std::string> names);

}  // namespace enfilade
