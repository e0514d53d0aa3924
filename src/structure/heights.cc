// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/heights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "enfilade/base/check.h"
#include "enfilade/structure/shared_scores.h"

namespace enfilade {
namespace {

// Under a wrong floor line (a kerb, a cabinet's plinth) the other line fits at a wrong height and
// distance. Only the correlation knows the distance: it weighs more in the search for heights.
constexpr double kCorrelationFactor = 2.0;
// So do the other panoramas.
constexpr double kShareFactor = 2.0;
// What a height loses for a squared standard deviation from its prior, mean response; no more than
// for ten of them.
constexpr double kPriorWeight = 0.01;
// The last search for the floor's height.
constexpr double kRefineReach_m = 0.06;
constexpr double kRefineStep_m = 0.01;
constexpr double kBaseboardStep_m = 0.01;
constexpr double kMinBaseboard_m = 0.035;
// Only near walls resolve the two lines.
constexpr double kBaseboardReach_m = 2.2;
// One side of the floor line's lobe must exceed the other by this share of its rise.
constexpr double kMinShoulder = 0.15;

// Scores of one panorama under hypothesised heights; without the correlation.
ColumnScores LineScores(const HeightView& view, double floor_z, double baseboard_m,
                        const double* ceiling_z, const DistanceBins& bins) {
  ColumnScores scores;
  if (view.use_floor) {
    AddScores(ScoreFloor(*view.response, view.position.z() - floor_z, baseboard_m, bins), 1.0,
              scores);
  }
  if (ceiling_z != nullptr)
    AddScores(ScoreLine(*view.response, view.position.z() - *ceiling_z, bins), 1.0, scores);
  return scores;
}

// The best wall path; its score as mean response a column.
WallPath BestPath(const HeightView& view, ColumnScores scores, const DistanceBins& bins,
                  const PlaneViterbiOptions& viterbi) {
  AddScores(*view.correlation, kCorrelationFactor, scores);
  WallPath path = FindWallPath(scores, bins, viterbi, false);
  path.score /= 360.0;
  return path;
}

// How well one floor height explains all panoramas, as mean response: the best wall path of each,
// and whether other panoramas see their lines where it has its walls. A wrong height moves every
// wall away from its own camera, so that panoramas contradict each other.
double FloorScore(std::span<const HeightView> views, const std::vector<std::vector<int>>& others,
                  double floor_z, double baseboard_m, const DistanceBins& bins,
                  const PlaneViterbiOptions& viterbi) {
  std::vector<ColumnScores> scores(views.size());
  std::vector<PlacedScores> placed;
  std::vector<WallPath> paths;
  std::vector<KnownDistances> known;
  // Whether walls are contradicted depends on furniture, not on the height.
  SharedScoresOptions share;
  share.contradiction = 0;
  double sum = 0;
  for (size_t v = 0; v < views.size(); ++v) {
    scores[v] = LineScores(views[v], floor_z, baseboard_m, nullptr, bins);
    placed.push_back({views[v].position.head<2>(), &scores[v]});
    paths.push_back(BestPath(views[v], scores[v], bins, viterbi));
    known.push_back(paths.back().wall_m);
    sum += paths.back().score;
  }
  for (size_t v = 0; v < views.size(); ++v) {
    if (views[v].use_floor) {
      sum += kShareFactor *
             ShareOfPath(placed, static_cast<int>(v), paths[v], others[v], known, bins, share);
    }
  }
  return sum / static_cast<double>(views.size());
}

double PriorLoss(double height_m, double mean_m, double sigma_m) {
  const double off = (height_m - mean_m) / sigma_m;
  return kPriorWeight * std::min(off * off, 100.0);
}

double MedianCameraZ(std::span<const HeightView> views) {
  std::vector<double> z;
  for (const HeightView& view : views) z.push_back(view.position.z());
  std::nth_element(z.begin(), z.begin() + static_cast<std::ptrdiff_t>(z.size() / 2), z.end());
  return z[z.size() / 2];
}

double Median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

size_t ArgMax(const std::vector<double>& values) {
  return static_cast<size_t>(std::max_element(values.begin(), values.end()) - values.begin());
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

// The score of each floor height, with the log prior on the camera height.
std::vector<double> ScoreFloors(std::span<const HeightView> views,
                                const std::vector<double>& floors, double baseboard_m,
                                double prior_camera_m, const DistanceBins& bins,
                                const PlaneViterbiOptions& viterbi, const HeightOptions& options,
                                RunContext& context) {
  std::vector<Eigen::Vector2d> positions;
  for (const HeightView& view : views) positions.push_back(view.position.head<2>());
  std::vector<std::vector<int>> others;
  for (size_t v = 0; v < views.size(); ++v) others.push_back(NearestOthers(positions, v));
  const double median_z = MedianCameraZ(views);
  std::vector<double> scores(floors.size());
  ParallelFor(context, "floor height", static_cast<int64_t>(floors.size()), [&](int64_t i) {
    const size_t h = static_cast<size_t>(i);
    scores[h] = FloorScore(views, others, floors[h], baseboard_m, bins, viterbi);
    const double camera_m = median_z - floors[h];
    scores[h] -=
        prior_camera_m > 0
            ? PriorLoss(camera_m, prior_camera_m, options.camera_prior_sigma_m)
            : PriorLoss(camera_m, options.typical_camera_m, options.typical_camera_sigma_m);
  });
  return scores;
}

// Mean response, along the near walls that a single floor line finds, at each height about that
// line.
std::vector<double> ResponseAboutFloor(std::span<const HeightView> views, double floor_z,
                                       const std::vector<double>& heights, const DistanceBins& bins,
                                       const PlaneViterbiOptions& viterbi, RunContext& context) {
  std::vector<std::vector<double>> profiles(views.size(), std::vector<double>(heights.size()));
  ParallelFor(context, "baseboard", static_cast<int64_t>(views.size()), [&](int64_t i) {
    const HeightView& view = views[static_cast<size_t>(i)];
    ColumnScores scores = ScoreFloor(*view.response, view.position.z() - floor_z, 0, bins);
    AddScores(*view.correlation, 1.0, scores);
    const WallPath path = FindWallPath(scores, bins, viterbi, false);
    for (size_t h = 0; h < heights.size(); ++h) {
      const ColumnScores line =
          ScoreLine(*view.response, view.position.z() - floor_z - heights[h], bins);
      double sum = 0;
      for (size_t c = 0; c < path.wall_m.size(); ++c) {
        if (path.wall_m[c] > kBaseboardReach_m) continue;
        const int bin =
            std::clamp(static_cast<int>(std::lround(bins.Bin(path.wall_m[c]))), 0, bins.count - 1);
        sum += line.family[static_cast<size_t>(path.family[c])](static_cast<int>(c), bin);
      }
      profiles[static_cast<size_t>(i)][h] = sum / static_cast<double>(path.wall_m.size());
    }
  });
  std::vector<double> mean(heights.size());
  for (const std::vector<double>& profile : profiles) {
    for (size_t h = 0; h < heights.size(); ++h)
      mean[h] += profile[h] / static_cast<double>(views.size());
  }
  return mean;
}

// Height of a second line about the floor line, 0 when there is none. At the resolution of a
// picture the second line is a shoulder of the first one's lobe, so the two sides of the lobe are
// compared.
double FindSecondLine(std::span<const HeightView> views, double floor_z, const DistanceBins& bins,
                      const PlaneViterbiOptions& viterbi, const HeightOptions& options,
                      RunContext& context) {
  const int reach = static_cast<int>(std::lround(options.max_baseboard_m / kBaseboardStep_m));
  std::vector<double> heights;
  for (int i = -reach; i <= reach; ++i) heights.push_back(i * kBaseboardStep_m);
  const std::vector<double> response =
      ResponseAboutFloor(views, floor_z, heights, bins, viterbi, context);
  const double rise = *std::max_element(response.begin(), response.end()) -
                      *std::min_element(response.begin(), response.end());
  std::vector<double> excess, height;
  for (int i = static_cast<int>(std::ceil(kMinBaseboard_m / kBaseboardStep_m)); i <= reach; ++i) {
    excess.push_back(response[static_cast<size_t>(reach + i)] -
                     response[static_cast<size_t>(reach - i)]);
    height.push_back(i * kBaseboardStep_m);
  }
  const auto [lowest, highest] = std::minmax_element(excess.begin(), excess.end());
  const bool is_above = *highest > -*lowest;
  if (std::max(*highest, -*lowest) <= kMinShoulder * rise) return 0;
  for (double& value : excess) value = is_above ? value : -value;
  const double peak = PeakPosition(excess, height);
  return is_above ? peak : -peak;
}

// Ceiling heights above the floor that are tried.
std::vector<double> CeilingCandidates(const HeightOptions& options) {
  std::vector<double> heights;
  for (double h = options.min_room_m; h <= options.max_room_m; h += options.step_m)
    heights.push_back(h);
  return heights;
}

}  // namespace

FloorEstimate EstimateFloor(std::span<const HeightView> views, double prior_camera_m,
                            const DistanceBins& bins, const PlaneViterbiOptions& viterbi,
                            const HeightOptions& options, RunContext& context) {
  ENFILADE_CHECK(!views.empty());
  const double median_z = MedianCameraZ(views);
  const double reach = 3 * options.camera_prior_sigma_m;
  const double low = prior_camera_m > 0 ? prior_camera_m - reach : options.min_camera_m;
  const double high = prior_camera_m > 0 ? prior_camera_m + reach : options.max_camera_m;
  std::vector<double> floors;
  for (double h = low; h <= high + 1e-9; h += options.step_m) floors.push_back(median_z - h);
  const std::vector<double> scores =
      ScoreFloors(views, floors, 0, prior_camera_m, bins, viterbi, options, context);
  FloorEstimate estimate{PeakPosition(scores, floors), 0, scores[ArgMax(scores)] - Median(scores)};

  const double second = FindSecondLine(views, estimate.floor_z, bins, viterbi, options, context);
  estimate.baseboard_m = std::abs(second);
  // The stronger line won the search. When that is the upper one, a floor that was found from the
  // pictures lies lower. One that was known does not: then the walls were too far, and the lower
  // line seemed to lie deeper than it does.
  if (second < 0 && prior_camera_m <= 0) estimate.floor_z += second;
  if (second < 0 && prior_camera_m > 0) estimate.baseboard_m /= 1 - second / prior_camera_m;

  // Once both lines are known, their height where they agree best with the correlation.
  floors.clear();
  for (double offset = -kRefineReach_m; offset <= kRefineReach_m + 1e-9; offset += kRefineStep_m) {
    floors.push_back(estimate.floor_z + offset);
  }
  const std::vector<double> refined = ScoreFloors(views, floors, estimate.baseboard_m,
                                                  prior_camera_m, bins, viterbi, options, context);
  estimate.floor_z = PeakPosition(refined, floors);
  return estimate;
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
        if (ceiling_z < views[v].position.z() + 0.2) return;
        curves[v][h] =
            BestPath(views[v],
                     LineScores(views[v], floor.floor_z, floor.baseboard_m, &ceiling_z, bins), bins,
                     viterbi)
                .score;
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
    const double num_views = static_cast<double>(same_room[v].size() + 1);
    std::vector<double> pooled = room;
    for (size_t h = 0; h < num_heights; ++h) {
      pooled[h] +=
          options.home_weight * home[h] -
          num_views * PriorLoss(heights[h], options.typical_room_m, options.typical_room_sigma_m);
    }
    const size_t best = ArgMax(pooled);
    const double contrast = pooled[best] / (num_views + options.home_weight);
    context.log().Debug(
        fmt::format("ceiling {:.2f} m above the floor, contrast {:.3f}", heights[best], contrast));
    const double level = std::clamp(contrast / options.level_contrast, 0.0, 1.0);
    estimates.push_back({floor.floor_z + PeakPosition(pooled, heights), level});
  }
  return estimates;
}

}  // namespace enfilade
