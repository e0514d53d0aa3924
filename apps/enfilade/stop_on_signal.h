// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/base/run_context.h"

namespace enfilade {

/// While it lives, the first SIGINT or SIGTERM asks `context` to stop; the second one kills as
/// usual. One at a time.
class StopOnSignal {
 public:
  explicit StopOnSignal(RunContext& context);
  ~StopOnSignal();
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;
};

/// The signal that asked to stop, 0 when none came.
[[nodiscard]] int StopSignal();

}  // namespace enfilade
