// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/base/check.h"

namespace enfilade {

void FailCheck(const char* file, int line, const char* condition, const std::string& detail) {
  std::string message =
      std::string(file) + ":" + std::to_string(line) + ": check failed: " + condition;
  if (!detail.empty()) message += " (" + detail + ")";
  throw std::logic_error(message);
}

}  // namespace enfilade
