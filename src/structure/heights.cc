// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/heights.h"

#include <algorithm>
#include <cmath>

#include "enfilade/base/check.h"

namespace enfilade {
namespace {

// Score of the best wall path of one panorama under hypothesised heights, as mean response a
// column.
double PathScore(const HeightView& view, double floor_z, double baseboard_m,
                 const double* ceiling_z, const DistanceBins& bins,
                 const PlaneViterbiOptions& viterbi) {
  ColumnScores scores;
  if (view.use_floor)
    AddScores(ScoreFloor(*view.response, view.camera_z - floor_z, baseboard_m, bins), 1.0, scores);
  if (ceiling_z != nullptr)
    AddScores(ScoreLine(*view.response, view.camera_z - *ceiling_z, bins), 1.0, scores);
  AddScores(*view.correlation, 1.0, scores);
  return FindWallPath(scores, bins, viterbi, false).score / 360.0;
}

double MedianCameraZ(std::span<const HeightView> views) {
  std::vector<double> z;
  for (const HeightView& view : views) z.push_back(view.camera_z);
  std::nth_element(z.begin(), z.begin() + static_cast<std::ptrdiff_t>(z.size() / 2), z.end());
  return z[z.size() / 2];
}

double Median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

// One hypothesis for floor and baseboard.
struct FloorHypothesis {
  double floor_z;
  double baseboard_m;
};

// Mean over the views of the path score of each hypothesis, with the log prior on the camera
// height.
std::vector<double> ScoreFloors(std::span<const HeightView> views,
                                const std::vector<FloorHypothesis>& hypotheses,
                                double prior_camera_m, const DistanceBins& bins,
                                const PlaneViterbiOptions& viterbi, const HeightOptions& options,
                                RunContext& context) {
  const int64_t num_views = static_cast<int64_t>(views.size());
  std::vector<double> scores(hypotheses.size() * views.size());
  ParallelFor(context, "floor height", static_cast<int64_t>(scores.size()), [&](int64_t i) {
    const FloorHypothesis& hypothesis = hypotheses[static_cast<size_t>(i / num_views)];
    scores[static_cast<size_t>(i)] =
        PathScore(views[static_cast<size_t>(i % num_views)], hypothesis.floor_z,
                  hypothesis.baseboard_m, nullptr, bins, viterbi);
  });
  const double median_z = MedianCameraZ(views);
  std::vector<double> means;
  for (size_t h = 0; h < hypotheses.size(); ++h) {
    double sum = 0;
    for (size_t v = 0; v < views.size(); ++v) sum += scores[h * views.size() + v];
    double mean = sum / static_cast<double>(views.size());
    if (prior_camera_m > 0) {
      const double off =
          (median_z - hypotheses[h].floor_z - prior_camera_m) / options.camera_prior_sigma_m;
      mean -= 0.01 * std::min(off * off, 100.0);
    }
    means.push_back(mean);
  }
  return means;
}

size_t ArgMax(const std::vector<double>& values) {
  return static_cast<size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

// Ceiling heights above the floor that are tried.
std::vector<double> CeilingCandidates(const HeightOptions& options) {
  std::vector<double> heights;
  for (double h = options.min_room_m; h <= options.max_room_m; h += options.step_m)
    heights.push_back(h);
  return heights;
}

// Position of the maximum of a sampled curve, refined by a parabola.
double PeakPosition(const std::vector<double>& curve, const std::vector<double>& x) {
  const size_t i = ArgMax(curve);
  if (i == 0 || i + 1 == curve.size()) return x[i];
  const double curvature = curve[i - 1] - 2 * curve[i] + curve[i + 1];
  if (curvature >= 0) return x[i];
  return x[i] +
         (x[i + 1] - x[i]) * std::clamp(0.5 * (curve[i - 1] - curve[i + 1]) / curvature, -0.5, 0.5);
}

}  // namespace

FloorEstimate EstimateFloor(std::span<const HeightView> views, double prior_camera_m,
                            const DistanceBins& bins, const PlaneViterbiOptions& viterbi,
                            const HeightOptions& options, RunContext& context) {
  ENFILADE_CHECK(!views.empty());
  const double median_z = MedianCameraZ(views);
  std::vector<FloorHypothesis> coarse;
  const double low =
      prior_camera_m > 0 ? prior_camera_m - 3 * options.camera_prior_sigma_m : options.min_camera_m;
  const double high =
      prior_camera_m > 0 ? prior_camera_m + 3 * options.camera_prior_sigma_m : options.max_camera_m;
  for (double h = low; h <= high + 1e-9; h += options.step_m) coarse.push_back({median_z - h, 0.0});
  const std::vector<double> coarse_scores =
      ScoreFloors(views, coarse, prior_camera_m, bins, viterbi, options, context);
  const FloorHypothesis start = coarse[ArgMax(coarse_scores)];

  // Floor and baseboard together: either of the two lines may have won the coarse search.
  std::vector<FloorHypothesis> fine;
  for (double offset = -0.10; offset <= 0.061; offset += 0.02) {
    for (double baseboard = 0; baseboard <= options.max_baseboard_m + 1e-9; baseboard += 0.02) {
      if (baseboard > 0 && baseboard < 0.035) continue;
      fine.push_back({start.floor_z + offset, baseboard});
    }
  }
  const std::vector<double> fine_scores =
      ScoreFloors(views, fine, prior_camera_m, bins, viterbi, options, context);
  const size_t best = ArgMax(fine_scores);
  return {fine[best].floor_z, fine[best].baseboard_m, fine_scores[best] - Median(coarse_scores)};
}

std::vector<CeilingEstimate> EstimateCeilings(std::span<const HeightView> views,
                                              const FloorEstimate& floor,
                                              const std::vector<std::vector<int>>& same_room,
                                              const DistanceBins& bins,
                                              const PlaneViterbiOptions& viterbi,
                                              const HeightOptions& options, RunContext& context) {
  ENFILADE_CHECK(same_room.size() == views.size());
  const std::vector<double> heights = CeilingCandidates(options);
  const size_t num_heights = heights.size();
  std::vector<std::vector<double>> curves(views.size(), std::vector<double>(num_heights));
  ParallelFor(
      context, "ceiling heights", static_cast<int64_t>(views.size() * num_heights), [&](int64_t i) {
        const size_t v = static_cast<size_t>(i) / num_heights,
                     h = static_cast<size_t>(i) % num_heights;
        const double ceiling_z = floor.floor_z + heights[h];
        if (ceiling_z < views[v].camera_z + 0.2) return;
        curves[v][h] =
            PathScore(views[v], floor.floor_z, floor.baseboard_m, &ceiling_z, bins, viterbi);
      });
  for (std::vector<double>& curve : curves) {
    const double median = Median(curve);
    for (double& value : curve) value = std::max(0.0, value - median);
  }
  std::vector<double> home(num_heights);
  for (const std::vector<double>& curve : curves) {
    for (size_t h = 0; h < num_heights; ++h)
      home[h] += curve[h] / static_cast<double>(curves.size());
  }

  std::vector<CeilingEstimate> estimates;
  for (size_t v = 0; v < views.size(); ++v) {
    std::vector<double> room = curves[v];
    for (const int u : same_room[v]) {
      for (size_t h = 0; h < num_heights; ++h) room[h] += curves[static_cast<size_t>(u)][h];
    }
    std::vector<double> pooled = room;
    for (size_t h = 0; h < num_heights; ++h) pooled[h] += options.home_weight * home[h];
    const size_t best = ArgMax(pooled);
    const double contrast = room[best] / static_cast<double>(same_room[v].size() + 1);
    const double level = std::clamp(contrast / options.level_contrast, 0.0, 1.0);
    estimates.push_back({floor.floor_z + PeakPosition(pooled, heights), level});
  }
  return estimates;
}

}  // namespace enfilade
