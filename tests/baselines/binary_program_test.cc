// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/baselines/binary_program.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "enfilade/base/errors.h"

namespace enfilade {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Infinity where no choice keeps the rows.
double BruteForce(const BinaryProgram& program) {
  double best = kInfinity;
  for (uint32_t bits = 0; bits < (1U << program.objective.size()); ++bits) {
    const auto x = [&](int variable) { return (bits >> variable) & 1U; };
    double cost = 0;
    for (size_t i = 0; i < program.objective.size(); ++i)
      cost += program.objective[i] * x(static_cast<int>(i));
    bool is_kept = true;
    for (const BinaryProgram::Row& row : program.rows) {
      double sum = 0;
      for (const auto& [variable, value] : row.coefficients) sum += value * x(variable);
      is_kept = is_kept && sum >= row.min - 1e-9 && sum <= row.max + 1e-9;
    }
    if (is_kept) best = std::min(best, cost);
  }
  return best;
}

TEST(SolveBinaryProgram, EqualsBruteForce) {
  std::mt19937 random(1);
  RunContext context(1);
  int num_feasible = 0;
  for (int trial = 0; trial < 100; ++trial) {
    BinaryProgram program;
    for (int i = 0; i < 8; ++i) program.objective.push_back(static_cast<int>(random() % 21) - 10);
    for (int r = 0; r < 4; ++r) {
      BinaryProgram::Row row;
      for (int i = 7; i >= 0; --i) {
        if (random() % 2 == 0) row.coefficients.emplace_back(i, static_cast<int>(random() % 7) - 3);
      }
      row.min = static_cast<int>(random() % 4) - 1;
      row.max = r == 0 ? kInfinity : row.min + static_cast<int>(random() % 3);
      program.rows.push_back(row);
    }
    const BinaryProgramReport report = SolveBinaryProgram(program, 1000, context);
    const double expected = BruteForce(program);
    if (std::isinf(expected)) {
      EXPECT_TRUE(report.x.empty()) << trial;
      EXPECT_NE(report.reason, "") << trial;
    } else {
      ++num_feasible;
      EXPECT_EQ(report.reason, "") << trial;
      EXPECT_NEAR(report.cost, expected, 1e-6) << trial;
    }
  }
  EXPECT_GT(num_feasible, 20);
}

TEST(SolveBinaryProgram, Stops) {
  RunContext context(1);
  context.RequestStop();
  EXPECT_THROW((void)SolveBinaryProgram({{1, 2}, {}}, 10, context), StoppedError);
}

}  // namespace
}  // namespace enfilade
