// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/base/options.h"

namespace enfilade {

/// The options of every stage, in flow order: what --config files hold, what --GROUP.NAME on the
/// command line sets, and what the reference page lists.
struct PipelineOptions {
  void Visit(OptionVisitor& /*v*/) {}
};

}  // namespace enfilade
