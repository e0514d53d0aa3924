// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/pair_selection.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace enfilade {
namespace {

// Stricter than for matches that are verified: what is left over is hardly ever false.
constexpr double kMaxCoarseRatio = 0.7;

// Number of matches of every two views, n × n, symmetric.
class MatchCounts {
 public:
  explicit MatchCounts(size_t num_views) : num_views_(num_views), counts_(num_views * num_views) {}
  void Set(size_t a, size_t b, size_t count) {
    counts_[a * num_views_ + b] = counts_[b * num_views_ + a] = static_cast<uint32_t>(count);
  }
  [[nodiscard]] std::span<const uint32_t> Of(size_t view) const {
    return std::span(counts_).subspan(view * num_views_, num_views_);
  }
  [[nodiscard]] size_t num_views() const { return num_views_; }

 private:
  size_t num_views_;
  std::vector<uint32_t> counts_;
};

std::vector<ViewPair> AllPairs(int num_views) {
  std::vector<ViewPair> pairs;
  for (int a = 0; a < num_views; ++a) {
    for (int b = a + 1; b < num_views; ++b) pairs.push_back({a, b});
  }
  return pairs;
}

// Features are held largest first.
DescriptorSet LargestOf(const PanoFeatures& features, int count) {
  const std::vector<uint8_t>& values = features.descriptors.values;
  const size_t num_values = std::min(values.size(), static_cast<size_t>(count) * kDescriptorSize);
  return {{values.begin(), values.begin() + static_cast<std::ptrdiff_t>(num_values)}};
}

MatchCounts CountCoarseMatches(std::span<const PanoFeatures> features, int num_coarse_features,
                               const DescriptorMatchOptions& match, RunContext& context) {
  DescriptorMatchOptions strict = match;
  strict.max_ratio = std::min(match.max_ratio, kMaxCoarseRatio);
  std::vector<DescriptorSet> coarse;
  for (const PanoFeatures& of_view : features) {
    coarse.push_back(LargestOf(of_view, num_coarse_features));
  }
  MatchCounts counts(features.size());
  ParallelFor(context, "compare panoramas", static_cast<int64_t>(features.size()), [&](int64_t k) {
    const size_t a = static_cast<size_t>(k);
    for (size_t b = a + 1; b < coarse.size(); ++b) {
      counts.Set(a, b, MatchDescriptors(coarse[a], coarse[b], strict).size());
    }
  });
  return counts;
}

std::vector<int64_t> TotalsOf(const MatchCounts& counts) {
  std::vector<int64_t> totals;
  for (size_t view = 0; view < counts.num_views(); ++view) {
    const std::span<const uint32_t> row = counts.Of(view);
    totals.push_back(std::accumulate(row.begin(), row.end(), int64_t{0}));
  }
  return totals;
}

// The views whose matches with one exceed most what they have with others on average, best first.
std::vector<int> BestPartners(const MatchCounts& counts, std::span<const int64_t> totals,
                              int view_idx, int num_partners) {
  std::vector<int> others(counts.num_views());
  std::iota(others.begin(), others.end(), 0);
  std::erase(others, view_idx);
  const std::span<const uint32_t> row = counts.Of(static_cast<size_t>(view_idx));
  const int64_t num_others = static_cast<int64_t>(others.size());
  const auto excess = [&](int other) {
    const size_t i = static_cast<size_t>(other);
    return num_others * row[i] - totals[i];
  };
  std::stable_sort(others.begin(), others.end(),
                   [&](int x, int y) { return excess(x) > excess(y); });
  others.resize(std::min(others.size(), static_cast<size_t>(num_partners)));
  return others;
}

}  // namespace

std::vector<ViewPair> SelectPairs(std::span<const PanoFeatures> features,
                                  const PairSelectionOptions& options,
                                  const DescriptorMatchOptions& match, RunContext& context) {
  const int num_views = static_cast<int>(features.size());
  if (num_views <= options.all_pairs_up_to) return AllPairs(num_views);
  const MatchCounts counts =
      CountCoarseMatches(features, options.num_coarse_features, match, context);
  const std::vector<int64_t> totals = TotalsOf(counts);
  std::vector<ViewPair> pairs;
  for (int view = 0; view < num_views; ++view) {
    for (const int other : BestPartners(counts, totals, view, options.num_partners)) {
      pairs.push_back({std::min(view, other), std::max(view, other)});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace enfilade
