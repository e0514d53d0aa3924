// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/descriptor_matcher.h"

#include <cmath>

#include "enfilade/base/check.h"
#include "src/sfm/nearest_descriptors.h"

namespace enfilade {
namespace {

static_assert((kMaxDescriptorValue & (kMaxDescriptorValue + 1)) == 0);  // CheckSet joins bits

void CheckSet(const DescriptorSet& set) {
  ENFILADE_CHECK(set.values.size() % kDescriptorSize == 0);
  uint8_t bits = 0;
  for (const uint8_t value : set.values) bits |= value;
  ENFILADE_CHECK(bits <= kMaxDescriptorValue);
}

double RatioOf(const NearestDescriptor& nearest) {
  if (nearest.second_squared_distance == NearestDescriptor::kFar) return 0;
  if (nearest.second_squared_distance == 0) return 1;
  return std::sqrt(static_cast<double>(nearest.squared_distance) / nearest.second_squared_distance);
}

}  // namespace

std::vector<FeatureMatch> MatchDescriptors(const DescriptorSet& a, const DescriptorSet& b,
                                           const DescriptorMatchOptions& options) {
  CheckSet(a);
  CheckSet(b);
  DescriptorMatchOptions checked = options;
  ValidateOptions(VisitorOf(checked), "descriptor matching");
  const NearestDescriptors nearest =
      FindNearestDescriptors(a, b, *UsableDescriptorKernels().front());
  const double max_distance = options.max_distance * kDescriptorScale;
  std::vector<FeatureMatch> matches;
  for (int a_idx = 0; a_idx < a.size(); ++a_idx) {
    const NearestDescriptor& match = nearest.in_b[static_cast<size_t>(a_idx)];
    if (match.idx < 0 || match.squared_distance > max_distance * max_distance) continue;
    const double ratio = RatioOf(match);
    if (ratio > options.max_ratio) continue;
    if (options.is_mutual && nearest.idx_in_a[static_cast<size_t>(match.idx)] != a_idx) continue;
    matches.push_back({a_idx, match.idx, static_cast<float>(ratio)});
  }
  return matches;
}

}  // namespace enfilade
