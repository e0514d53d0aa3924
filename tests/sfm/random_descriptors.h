// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>

#include "enfilade/sfm/descriptor_matcher.h"

namespace enfilade {

/// Any values at all in 0 … max_value; small ones make many descriptors equally near.
inline DescriptorSet RandomValues(int size, int max_value, uint32_t seed) {
  DescriptorSet set;
  std::mt19937 random(seed);
  set.values.resize(static_cast<size_t>(size) * kDescriptorSize);
  for (uint8_t& value : set.values)
    value = static_cast<uint8_t>(random() % static_cast<uint32_t>(max_value + 1));
  return set;
}

}  // namespace enfilade
