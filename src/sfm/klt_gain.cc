// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/klt_gain.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "enfilade/base/check.h"
#include "enfilade/base/median.h"

namespace enfilade {
namespace {

constexpr int kNumReweightings = 10;
// Deviations below this are not held against a window: far below what matters.
constexpr double kMinScale = 1e-4;

}  // namespace

ReducedGain EliminateDisplacement(const GainBlock& block) {
  const Eigen::Vector2d moved = block.tensor.inverse() * block.coupling;
  const double information = block.gain - block.coupling.dot(moved);
  // Windows that a shift changes as a gain does (all of one exponential) cannot tell them apart.
  if (!(information > 1e-6 * block.gain)) return {};
  return {(block.gain_residual - moved.dot(block.gradient_residual)) / information, information};
}

double InformationMean(std::span<const double> values, std::span<const double> information) {
  ENFILADE_CHECK(values.size() == information.size());
  double sum = 0, total = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    sum += information[i] * values[i];
    total += information[i];
  }
  return total > 0 ? sum / total : 0;
}

double RobustInformationMean(std::span<const double> values, std::span<const double> information) {
  ENFILADE_CHECK(values.size() == information.size());
  std::vector<double> informed;
  for (size_t i = 0; i < values.size(); ++i) {
    if (information[i] > 0) informed.push_back(values[i]);
  }
  if (informed.empty()) return 0;
  double mean = UpperMedian(informed);
  for (double& value : informed) value = std::abs(value - mean);
  const double scale = std::max(1.4826 * UpperMedian(informed), kMinScale);
  std::vector<double> weights(values.size());
  for (int round = 0; round < kNumReweightings; ++round) {
    for (size_t i = 0; i < values.size(); ++i) {
      const double z = (values[i] - mean) / scale;
      weights[i] = information[i] / (1 + z * z);
    }
    mean = InformationMean(values, weights);
  }
  return mean;
}

}  // namespace enfilade
