// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <span>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/sfm/descriptor_matcher.h"
#include "enfilade/sfm/types.h"

namespace enfilade {

struct PairSelectionOptions {
  int all_pairs_up_to = 100;
  int num_partners = 30;
  int num_coarse_features = 700;

  void Visit(OptionVisitor& v) {
    v("all_pairs_up_to", all_pairs_up_to, "Up to so many panoramas each is matched with each.",
      {2.0, 100000.0});
    v("num_partners", num_partners,
      "Of more panoramas each is matched with so many that look most like it.", {1.0, 100000.0});
    v("num_coarse_features", num_coarse_features,
      "Largest features of a panorama that tell which look like it.", {10.0, 100000.0});
  }
};

/// Two views that are to be matched, a_idx < b_idx.
struct ViewPair {
  int a_idx = 0, b_idx = 0;

  auto operator<=>(const ViewPair&) const = default;
};

/// The pairs that are worth matching, ascending: all of up to options.all_pairs_up_to panoramas. Of
/// more, the largest features of all are matched, each panorama proposes the options.num_partners
/// whose matches with it exceed most what they have with others on average (ties: lowest index),
/// and what one of the two proposes is taken. (Preemptive matching: Wu, Towards Linear-time
/// Incremental Structure from Motion, 3DV 2013; there the plain number of matches counts, by which
/// panoramas of much repeated things are everyone's partners.)
///
/// Large features are few, are seen from near and far, and tell rooms apart; all against all they
/// cost (num_coarse_features / max_features)² of matching all pairs: still quadratic, but at 1000
/// panoramas a small part of the whole. Memory: n² counts.
[[nodiscard]] std::vector<ViewPair> SelectPairs(std::span<const PanoFeatures> features,
                                                const PairSelectionOptions& options,
                                                const DescriptorMatchOptions& match,
                                                RunContext& context);

}  // namespace enfilade
