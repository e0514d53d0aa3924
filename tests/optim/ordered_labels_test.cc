// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/optim/ordered_labels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace enfilade {
namespace {

struct Problem {
  std::vector<double> costs;
  int num_labels = 3;
  std::vector<LabelEdge> edges;

  [[nodiscard]] int num_nodes() const { return static_cast<int>(costs.size()) / num_labels; }
};

double Energy(const Problem& problem, const std::vector<int>& label) {
  double energy = 0;
  for (int p = 0; p < problem.num_nodes(); ++p)
    energy +=
        problem.costs[static_cast<size_t>(p * problem.num_labels + label[static_cast<size_t>(p)])];
  for (const LabelEdge& edge : problem.edges) {
    const int steps = label[static_cast<size_t>(edge.p)] - label[static_cast<size_t>(edge.q)];
    energy += std::max(0, steps) * edge.p_above + std::max(0, -steps) * edge.q_above;
  }
  return energy;
}

double LeastEnergy(const Problem& problem) {
  std::vector<int> label(static_cast<size_t>(problem.num_nodes()));
  double least = std::numeric_limits<double>::infinity();
  while (true) {
    least = std::min(least, Energy(problem, label));
    size_t p = 0;
    while (p < label.size() && ++label[p] == problem.num_labels) label[p++] = 0;
    if (p == label.size()) return least;
  }
}

TEST(FindOrderedLabels, EqualsBruteForce) {
  std::mt19937 random(5);
  const auto draw = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  for (int round = 0; round < 400; ++round) {
    Problem problem;
    problem.num_labels = 2 + draw(3);
    const int num_nodes = 1 + draw(6);
    // Costs are multiples that rounding keeps exactly, some below zero.
    for (int i = 0; i < num_nodes * problem.num_labels; ++i) problem.costs.push_back(draw(65) - 16);
    problem.costs[0] = 64;
    for (int i = 0; num_nodes > 1 && i < draw(12); ++i) {
      LabelEdge edge{draw(num_nodes), draw(num_nodes - 1), static_cast<double>(draw(20)),
                     static_cast<double>(draw(3) == 0 ? 0 : draw(20))};
      edge.q += edge.q >= edge.p;
      problem.edges.push_back(edge);
    }
    const OrderedLabels found = FindOrderedLabels(problem.costs, problem.num_labels, problem.edges);
    ASSERT_EQ(found.energy, Energy(problem, found.label)) << round;
    ASSERT_EQ(found.energy, LeastEnergy(problem)) << round;
  }
}

TEST(FindOrderedLabels, OrderIsKeptWhereItIsDear) {
  // Both nodes would rather be the other way round; the first may not be below the second.
  const std::vector<double> costs = {0, 1, 9, 9, 1, 0};
  const std::vector<LabelEdge> edges = {{0, 1, 0, 100}};
  EXPECT_THAT(FindOrderedLabels(costs, 3, {}).label, testing::ElementsAre(0, 2));
  EXPECT_THAT(FindOrderedLabels(costs, 3, edges).label, testing::ElementsAre(1, 1));
}

TEST(FindOrderedLabels, OfEqualLabellingsTheLowest) {
  EXPECT_THAT(FindOrderedLabels(std::vector<double>(6, 1.0), 3, {}).label,
              testing::ElementsAre(0, 0));
  EXPECT_TRUE(FindOrderedLabels({}, 3, {}).label.empty());
}

}  // namespace
}  // namespace enfilade
