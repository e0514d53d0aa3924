// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "tests/support/source_folder.h"

namespace enfilade {

/// The folder of real data: $ENFILADE_DATA, else ../shared/data beside the checkout.
inline std::filesystem::path RealDataFolder() {
  const char* folder = std::getenv("ENFILADE_DATA");
  return folder != nullptr ? std::filesystem::path(folder) : SourceFolder() / "../shared/data";
}

}  // namespace enfilade

/// Skips the test with a message where the real data `name` is absent.
#define ENFILADE_REQUIRE_REAL_DATA(name)                               \
  if (!std::filesystem::exists(::enfilade::RealDataFolder() / (name))) \
  GTEST_SKIP() << "real data '" << (name) << "' is absent; set ENFILADE_DATA to run this test"
