// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

namespace enfilade {

/// How often colours occur on floor, wall and ceiling (labels 0, 1, 2): histograms over CIELAB in
/// steps of 5, smoothed by about as much.
class ColourModel {
 public:
  static constexpr int kNumLabels = 3;

  ColourModel();
  void Add(int label, const std::array<float, 3>& lab, double weight);
  void Add(const ColourModel& other);
  /// What has been added is smoothed and made a density: sums to one for each label with any
  /// colour. After this nothing may be added.
  void Finish();
  /// Of a finished model; zero for a label without colours.
  [[nodiscard]] double Density(int label, const std::array<float, 3>& lab) const;

 private:
  std::array<std::vector<double>, kNumLabels> counts_;
};

}  // namespace enfilade
