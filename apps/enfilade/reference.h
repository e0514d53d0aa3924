// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace enfilade {

/// docs/command_reference.md: every command with its arguments, and every option of every stage.
[[nodiscard]] std::string CommandReference();

}  // namespace enfilade
