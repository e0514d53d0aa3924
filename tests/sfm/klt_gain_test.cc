// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/klt_gain.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace enfilade {
namespace {

// Normal equations of windows of random gradients, grey levels and residuals.
std::vector<GainBlock> RandomBlocks(int count, int seed) {
  std::mt19937 random(static_cast<unsigned>(seed));
  std::normal_distribution<double> normal;
  std::vector<GainBlock> blocks(static_cast<size_t>(count));
  for (GainBlock& block : blocks) {
    block.tensor.setZero();
    for (int pixel = 0; pixel < 64; ++pixel) {
      const Eigen::Vector2d g(normal(random), 0.3 + normal(random));
      const double t = 3 + normal(random), e = 0.2 * normal(random);
      block.tensor += g * g.transpose();
      block.coupling += t * g;
      block.gain += t * t;
      block.gradient_residual += g * e;
      block.gain_residual += t * e;
    }
  }
  return blocks;
}

// The whole system of all displacements and one gain, solved as a dense one.
double DenseGain(const std::vector<GainBlock>& blocks) {
  const Eigen::Index n = static_cast<Eigen::Index>(2 * blocks.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n + 1, n + 1);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n + 1);
  for (size_t i = 0; i < blocks.size(); ++i) {
    const Eigen::Index at = static_cast<Eigen::Index>(2 * i);
    a.block<2, 2>(at, at) = blocks[i].tensor;
    a.block<2, 1>(at, n) = -blocks[i].coupling;
    a.block<1, 2>(n, at) = -blocks[i].coupling.transpose();
    a(n, n) += blocks[i].gain;
    b.segment<2>(at) = -blocks[i].gradient_residual;
    b[n] += blocks[i].gain_residual;
  }
  return a.fullPivLu().solve(b)[n];
}

TEST(InformationMean, OfReducedBlocksSolvesTheBlockArrowSystem) {
  for (int seed = 0; seed < 20; ++seed) {
    const std::vector<GainBlock> blocks = RandomBlocks(1 + seed, seed);
    std::vector<double> steps, information;
    for (const GainBlock& block : blocks) {
      const ReducedGain reduced = EliminateDisplacement(block);
      steps.push_back(reduced.step);
      information.push_back(reduced.information);
    }
    EXPECT_NEAR(InformationMean(steps, information), DenseGain(blocks), 1e-12) << seed;
  }
}

TEST(EliminateDisplacement, AnExponentialCannotTellAGainFromAShift) {
  GainBlock block;
  block.tensor << 4, 0, 0, 1;
  block.coupling = {2, 0};  // all pixels have grey level 1 and gradient 2 along x
  block.gain = 1;
  block.gain_residual = 0.1;
  EXPECT_EQ(EliminateDisplacement(block).information, 0);
  EXPECT_EQ(EliminateDisplacement(block).step, 0);
}

TEST(RobustInformationMean, AThirdOfWrongVotesHasLittleSay) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::vector<double> votes, information(300, 1.0);
  for (int i = 0; i < 300; ++i) votes.push_back(i % 3 == 0 ? 0.8 : 0.2 + 0.01 * normal(random));
  EXPECT_NEAR(RobustInformationMean(votes, information), 0.2, 0.003);
  // Also when the wrong ones hold most of the information.
  for (size_t i = 0; i < 300; i += 3) information[i] = 10;
  EXPECT_NEAR(RobustInformationMean(votes, information), 0.2, 0.02);
}

TEST(RobustInformationMean, EqualVotesAreTheMeanAndNoVotesAreZero) {
  const std::vector<double> votes(5, 0.25), information = {1, 2, 0, 4, 5}, none(5, 0.0);
  EXPECT_DOUBLE_EQ(RobustInformationMean(votes, information), 0.25);
  EXPECT_EQ(RobustInformationMean(votes, none), 0);
  EXPECT_EQ(RobustInformationMean({}, {}), 0);
}

}  // namespace
}  // namespace enfilade
