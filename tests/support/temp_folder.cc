// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/temp_folder.h"

#include <stdlib.h>  // NOLINT: mkdtemp is POSIX

#include <string>
#include <system_error>

#include "enfilade/base/check.h"

namespace enfilade {

TempFolder::TempFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "enfilade-test-XXXXXX").native();
  ENFILADE_CHECK(mkdtemp(name.data()) != nullptr);
  path_ = name;
}

TempFolder::~TempFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace enfilade
