// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/base/run_context.h"
#include "enfilade/scene/types.h"

namespace enfilade {

/// A low estimate of the peak memory of a whole run, in MB: what it surely needs.
[[nodiscard]] double LeastMemoryMb(const Scene& scene, int num_threads);

/// Throws InvalidInputError when the context's cap is below LeastMemoryMb; warns when the machine
/// has less than that left.
void RequireMemory(const Scene& scene, RunContext& context);

}  // namespace enfilade
