// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/enfilade/synth_home.h"

#include <system_error>

#include "enfilade/base/errors.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

// An older home may be replaced, anything else not.
void CheckFolder(const fs::path& folder) {
  std::error_code error;
  const bool is_free = !fs::exists(folder, error) || fs::is_empty(folder, error);
  if (!is_free && !fs::exists(folder / "truth", error)) {
    throw InvalidInputError(folder.native(), "is not empty and is no synthetic home",
                            "choose another folder with -o");
  }
}

}  // namespace

Home SynthesiseHome(const fs::path& folder, const SynthOptions& options, RunContext& context) {
  WriteHomeOptions pictures = options.pictures;
  if (pictures.width == 0) pictures.width = UsualWidth(options.home.preset);
  CheckFolder(folder);
  Home home = MakeHome(options.home);
  WriteHome(folder, home, pictures, context);
  return home;
}

}  // namespace enfilade
