// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "enfilade/base/options.h"

namespace enfilade {

/// Values of a descriptor.
inline constexpr int kDescriptorSize = 128;
/// A unit descriptor's values are multiplied by this and cut at kMaxDescriptorValue.
inline constexpr double kDescriptorScale = 256;
inline constexpr uint8_t kMaxDescriptorValue = 127;

/// The descriptors of one picture's features. RootSIFT (Arandjelović and Zisserman 2012) has unit
/// length and no negative values, so 7 bits hold it.
struct DescriptorSet {
  /// n × kDescriptorSize, row by row, each value in 0 … kMaxDescriptorValue.
  std::vector<uint8_t> values;

  [[nodiscard]] int size() const { return static_cast<int>(values.size() / kDescriptorSize); }
  /// The kDescriptorSize values of a descriptor; the index is not checked.
  [[nodiscard]] const uint8_t* row(int idx) const {
    return values.data() + static_cast<size_t>(idx) * kDescriptorSize;
  }
};

struct DescriptorMatchOptions {
  double max_ratio = 0.8;
  double max_distance = 0.7;
  bool is_mutual = true;

  void Visit(OptionVisitor& v) {
    v("max_ratio", max_ratio,
      "A match's distance is at most this share of the distance to the second best; 1: any.",
      {0.0, 1.0});
    v("max_distance", max_distance, "Largest distance of a match, between descriptors of length 1.",
      {0.0, 2.0});
    v("is_mutual", is_mutual, "Each of the two has to be the nearest of the other.");
  }
};

struct FeatureMatch {
  int a_idx = 0;
  int b_idx = 0;
  /// Distance over the distance from a_idx to its second best in b, in [0, 1]; 0 where b has no
  /// other, 1 where both distances are 0.
  float ratio = 0;

  bool operator==(const FeatureMatch&) const = default;
};

/// For each descriptor of `a` the one of `b` at the least Euclidean distance, where it passes
/// Lowe's ratio test (2004, section 7.1), is near enough and, unless switched off, has none nearer
/// in `a`. Of equally near ones the lowest index counts. Ascending in a_idx; with is_mutual each
/// b_idx stands at most once.
///
/// Compares all with all: |a|·|b|·128 products, in one thread, and memory for a copy of `b`.
/// Distances are exact integers, so every machine finds the same, whatever instructions it has
/// (AVX-512 VNNI, AVX-VNNI, AVX2, SSE2 or none of these).
///
/// Throws std::logic_error for a set whose number of values is no multiple of 128 or that holds a
/// value above 127, InvalidInputError for options out of range.
[[nodiscard]] std::vector<FeatureMatch> MatchDescriptors(const DescriptorSet& a,
                                                         const DescriptorSet& b,
                                                         const DescriptorMatchOptions& options);

}  // namespace enfilade
