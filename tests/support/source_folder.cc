// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/source_folder.h"

namespace enfilade {

std::filesystem::path SourceFolder() { return ENFILADE_SOURCE_DIR; }

}  // namespace enfilade
