// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "enfilade/base/run_context.h"

namespace enfilade {

/// Minimise objective · x over x in {0, 1}ⁿ, every row being within its bounds.
struct BinaryProgram {
  struct Row {
    std::vector<std::pair<int, double>> coefficients;  ///< by variable, each once
    double min = 0;
    double max = 0;  ///< infinity for no bound
  };
  std::vector<double> objective;  ///< one entry a variable
  std::vector<Row> rows;
};

struct BinaryProgramReport {
  std::vector<uint8_t> x;  ///< the optimum; empty when none was found
  double cost = 0;
  std::string reason;  ///< why there is none, one line
};

/// An optimum, by branch and bound (GLPK). Gives up beyond `max_nodes` subproblems. Variables
/// within a row are put in order, so the same program gives the same answer. Throws StoppedError,
/// between two subproblems. Cost exponential at worst.
[[nodiscard]] BinaryProgramReport SolveBinaryProgram(BinaryProgram program, int max_nodes,
                                                     RunContext& context);

}  // namespace enfilade
