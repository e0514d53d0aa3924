// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "enfilade/optim/grid_cut.h"

namespace enfilade {

/// boykov_kolmogorov_max_flow of Boost.Graph on a general graph with the same nodes and edges as a
/// grid, as reference and rival.
class BoostGridCut {
 public:
  explicit BoostGridCut(const GridCutProblem& problem);
  ~BoostGridCut();
  BoostGridCut(const BoostGridCut&) = delete;
  BoostGridCut& operator=(const BoostGridCut&) = delete;

  /// The largest flow; may be called again.
  [[nodiscard]] int64_t Solve();

 private:
  struct Graph;
  std::unique_ptr<Graph> graph_;
};

}  // namespace enfilade
