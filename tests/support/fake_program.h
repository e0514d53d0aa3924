// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "enfilade/base/file.h"

namespace enfilade {

/// Writes a shell script that succeeds for `help` and else does what `body` says. Returns its path.
inline std::string FakeProgram(const std::filesystem::path& path, std::string_view body) {
  WriteFileAtomic(path, "#!/bin/sh\n[ \"$1\" = help ] && exit 0\n" + std::string(body) + "\n");
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path.native();
}

}  // namespace enfilade
