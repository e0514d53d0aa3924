// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "enfilade/base/run_context.h"
#include "enfilade/scene/types.h"
#include "enfilade/sfm/features.h"

namespace enfilade {

/// A low estimate of the peak memory of a whole run with given poses, in MB: what it surely needs.
[[nodiscard]] double LeastMemoryMb(const Scene& scene, int num_threads);

/// The same of the stage sfm alone. Where it finds the poses it holds the features of all pictures.
[[nodiscard]] double LeastSfmMemoryMb(const Scene& scene, const FeatureOptions& options,
                                      int num_threads);

/// Throws InvalidInputError, with `cure`, when the context's cap is below `need_mb`; warns when the
/// machine has less than that left.
void RequireMemory(double need_mb, const std::string& cure, RunContext& context);

/// Of a whole run with given poses.
void RequireMemory(const Scene& scene, RunContext& context);

}  // namespace enfilade
