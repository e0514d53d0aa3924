// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

namespace enfilade {

/// What two labels cost together: `p_above` for each step that p's label is above q's, `q_above`
/// for each step that q's is above p's. Neither is negative.
struct LabelEdge {
  int p = 0, q = 0;
  double p_above = 0, q_above = 0;
};

struct OrderedLabels {
  std::vector<int> label;  ///< one a node, 0 … K − 1
  double energy = 0;
};

/// The labels of least energy, exactly: Σ cost(node, label) + Σ over edges, labels being ordered.
///
/// `costs` is nodes × num_labels, row by row, finite; num_labels K ≥ 2. One minimum cut (Ishikawa,
/// PAMI 2003, for costs linear in the difference of labels): K − 1 vertices a node. Costs are
/// rounded to 2⁻²⁰ of the largest one, so that the result is the same everywhere; of several best
/// labellings the one with the lowest labels. The flow is Boost.Graph's (Boykov and Kolmogorov,
/// PAMI 2004).
[[nodiscard]] OrderedLabels FindOrderedLabels(std::span<const double> costs, int num_labels,
                                              std::span<const LabelEdge> edges);

}  // namespace enfilade
