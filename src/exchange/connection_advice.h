// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "src/exchange/connection_facts.h"

namespace enfilade {

/// Why a pair got its verdict, in plain words.
[[nodiscard]] std::string ReasonFor(const PairFact& pair);

/// What the user can do about a refused pair.
[[nodiscard]] std::string CureFor(const PairFact& pair);

/// For every component but the largest, one sentence that says how it could be tied to the others:
/// between which two pictures one more should be taken. Single pictures come last; of many only the
/// first are named.
[[nodiscard]] std::vector<std::string> WhatToDo(const ConnectionFacts& facts);

}  // namespace enfilade
