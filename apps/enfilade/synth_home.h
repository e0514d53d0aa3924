// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/synthetic/home.h"
#include "enfilade/synthetic/write_home.h"

namespace enfilade {

/// A home to be made and the pictures of it.
struct SynthOptions {
  HomeOptions home;
  WriteHomeOptions pictures;

  SynthOptions() { pictures.width = 0; }

  void Visit(OptionVisitor& v) {
    v("home", home, "The home itself.");
    v("pictures", pictures, "Its panoramas.");
  }
};

/// Makes the home and writes it to `folder`, which must be free or hold such a home. Throws
/// InvalidInputError, IoError, StoppedError.
Home SynthesiseHome(const std::filesystem::path& folder, const SynthOptions& options,
                    RunContext& context);

}  // namespace enfilade
