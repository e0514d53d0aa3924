// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/relative_path.h"

namespace enfilade {

namespace fs = std::filesystem;

fs::path RelativePath(const fs::path& file, const fs::path& folder) {
  if (file.empty()) return {};
  const fs::path absolute = fs::absolute(file);
  return (fs::weakly_canonical(absolute.parent_path()) / absolute.filename())
      .lexically_relative(fs::weakly_canonical(fs::absolute(folder)));
}

}  // namespace enfilade
