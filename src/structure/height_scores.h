// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "enfilade/structure/heights.h"

namespace enfilade {

/// Under a wrong floor line (a kerb, a cabinet's plinth) the other line fits at a wrong height and
/// distance. Only the correlation knows the distance: it weighs more in the search for heights.
inline constexpr double kCorrelationFactor = 2.0;

/// Scores of one panorama's floor line under a hypothesised height; none where the floor does not
/// count.
[[nodiscard]] ColumnScores FloorLineScores(const HeightView& view, double floor_z,
                                           const Baseboard& baseboard, const DistanceBins& bins);

/// The best wall path; its score as mean response a column.
[[nodiscard]] WallPath BestPath(const ColumnScores& scores, const DistanceBins& bins,
                                const PlaneViterbiOptions& viterbi);

/// What a height loses, in mean response, because it usually is another.
[[nodiscard]] double PriorLoss(double height_m, double mean_m, double sigma_m);

/// Index of the first of the largest values.
[[nodiscard]] size_t ArgMax(const std::vector<double>& values);

/// Position of the maximum of a curve sampled at `x`, refined by a parabola.
[[nodiscard]] double PeakPosition(const std::vector<double>& curve, const std::vector<double>& x);

}  // namespace enfilade
