// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace enfilade {

/// Throws std::logic_error naming the place and the violated condition: a bug, never bad input.
[[noreturn]] void FailCheck(const char* file, int line, const char* condition,
                            const std::string& detail = {});

}  // namespace enfilade

/// Checks an invariant or a precondition. A violation is a bug in the caller or in this library.
#define ENFILADE_CHECK(condition)                                            \
  do {                                                                       \
    if (!(condition)) ::enfilade::FailCheck(__FILE__, __LINE__, #condition); \
  } while (false)

/// As ENFILADE_CHECK, with a std::string that tells the offending values.
#define ENFILADE_CHECK_MSG(condition, detail)                                        \
  do {                                                                               \
    if (!(condition)) ::enfilade::FailCheck(__FILE__, __LINE__, #condition, detail); \
  } while (false)
