// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "src/exchange/connection_facts.h"

namespace enfilade {

/// The content of connections.json (docs/formats-output.md).
[[nodiscard]] nlohmann::json ConnectionsToJson(const ConnectionFacts& facts);

}  // namespace enfilade
