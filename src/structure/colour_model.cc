// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/structure/colour_model.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace enfilade {
namespace {

constexpr double kStep = 5;
constexpr int kNumL = 21, kNumAb = 29;  // L 0 … 100, a and b −70 … 70
constexpr std::array<size_t, 3> kStride = {static_cast<size_t>(kNumAb * kNumAb), kNumAb, 1};
constexpr std::array<int, 3> kSize = {kNumL, kNumAb, kNumAb};
constexpr size_t kNumBins = static_cast<size_t>(kNumL * kNumAb * kNumAb);

size_t BinOf(const std::array<float, 3>& lab) {
  size_t bin = 0;
  for (size_t k = 0; k < 3; ++k) {
    const double from = k == 0 ? 0 : -0.5 * kStep * (kNumAb - 1);
    const int at = static_cast<int>((lab[k] - from) / kStep + 0.5);
    bin += kStride[k] * static_cast<size_t>(std::clamp(at, 0, kSize[k] - 1));
  }
  return bin;
}

// Along one axis by 1 4 6 4 1; beyond the ends the last bin goes on.
void Smooth(size_t axis, std::vector<double>& counts) {
  constexpr std::array<double, 5> kKernel = {1.0 / 16, 4.0 / 16, 6.0 / 16, 4.0 / 16, 1.0 / 16};
  const int size = kSize[axis];
  std::vector<double> line(static_cast<size_t>(size));
  for (size_t bin = 0; bin < counts.size(); ++bin) {
    if (bin / kStride[axis] % static_cast<size_t>(size) != 0) continue;
    for (int i = 0; i < size; ++i) {
      double sum = 0;
      for (int k = -2; k <= 2; ++k) {
        const auto at = static_cast<size_t>(std::clamp(i + k, 0, size - 1));
        sum += kKernel[static_cast<size_t>(k + 2)] * counts[bin + at * kStride[axis]];
      }
      line[static_cast<size_t>(i)] = sum;
    }
    for (size_t i = 0; i < line.size(); ++i) counts[bin + i * kStride[axis]] = line[i];
  }
}

}  // namespace

ColourModel::ColourModel() {
  for (std::vector<double>& counts : counts_) counts.assign(kNumBins, 0);
}

void ColourModel::Add(int label, const std::array<float, 3>& lab, double weight) {
  counts_[static_cast<size_t>(label)][BinOf(lab)] += weight;
}

void ColourModel::Add(const ColourModel& other) {
  for (size_t label = 0; label < kNumLabels; ++label) {
    for (size_t bin = 0; bin < kNumBins; ++bin) counts_[label][bin] += other.counts_[label][bin];
  }
}

void ColourModel::Finish() {
  for (std::vector<double>& counts : counts_) {
    for (const size_t axis : {0, 1, 2}) Smooth(axis, counts);
    const double sum = std::accumulate(counts.begin(), counts.end(), 0.0);
    if (sum <= 0) continue;
    for (double& count : counts) count /= sum;
  }
}

double ColourModel::Density(int label, const std::array<float, 3>& lab) const {
  return counts_[static_cast<size_t>(label)][BinOf(lab)];
}

}  // namespace enfilade
