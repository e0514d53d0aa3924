// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "enfilade/sfm/descriptor_matcher.h"
#include "src/sfm/descriptor_kernel.h"

namespace enfilade {

/// The kernels that this machine can run, the fastest first; never empty.
[[nodiscard]] std::vector<const DescriptorKernel*> UsableDescriptorKernels();

/// The nearest descriptor of another set, the lowest index of equally near ones.
struct NearestDescriptor {
  static constexpr int32_t kFar = std::numeric_limits<int32_t>::max();

  int idx = -1;                            ///< −1 where the other set is empty
  int32_t squared_distance = kFar;         ///< in quantised units
  int32_t second_squared_distance = kFar;  ///< to the nearest but this; kFar where there is none

  bool operator==(const NearestDescriptor&) const = default;
};

struct NearestDescriptors {
  std::vector<NearestDescriptor> in_b;  ///< for each descriptor of `a`
  std::vector<int> idx_in_a;            ///< for each of `b`, −1 where `a` is empty
};

/// Nearest neighbours both ways, all products once. The result does not depend on the kernel.
/// Requires what MatchDescriptors requires of the sets.
[[nodiscard]] NearestDescriptors FindNearestDescriptors(const DescriptorSet& a,
                                                        const DescriptorSet& b,
                                                        const DescriptorKernel& kernel);

}  // namespace enfilade
