// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/heights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

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
// Only near walls resolve the two lines.
constexpr double kBaseboardReach_m = 2.2;
// One side of the floor line's lobe must exceed the other, in the mean from here on, by this share
// of the lobe's rise. Nearer to the line a lobe that is off by half a step has unequal flanks.
constexpr double kMinShoulder_m = 0.055;
constexpr double kMinShoulder = 0.045;

// Scores of one panorama's floor line under a hypothesised height.
ColumnScores FloorLineScores(const HeightView& view, double floor_z, const Baseboard& baseboard,
                             const DistanceBins& bins) {
  if (!view.use_floor) return {};
  return ScoreFloor(*view.response, view.position.z() - floor_z, baseboard, bins);
}

// The best wall path; its score as mean response a column.
WallPath BestPath(const ColumnScores& scores, const DistanceBins& bins,
                  const PlaneViterbiOptions& viterbi) {
  WallPath path = FindWallPath(scores, bins, viterbi, false);
  path.score /= 360.0;
  return path;
}

// How well one floor height explains all panoramas, as mean response: the best wall path of each,
// and whether other panoramas see their lines where it has its walls. A wrong height moves every
// wall away from its own camera, so that panoramas contradict each other.
double FloorScore(std::span<const HeightView> views, const std::vector<std::vector<int>>& others,
                  double floor_z, const Baseboard& baseboard, const DistanceBins& bins,
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
    scores[v] = FloorLineScores(views[v], floor_z, baseboard, bins);
    placed.push_back({views[v].position.head<2>(), &scores[v]});
    ColumnScores all = scores[v];
    AddScores(*views[v].correlation, kCorrelationFactor, all);
    paths.push_back(BestPath(all, bins, viterbi));
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
                                const std::vector<double>& floors, const Baseboard& baseboard,
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
    scores[h] = FloorScore(views, others, floors[h], baseboard, bins, viterbi);
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
    ColumnScores scores = ScoreFloor(*view.response, view.position.z() - floor_z, {}, bins);
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

// A second line about the one that was found.
struct SecondLine {
  double height_m = 0;  // above the first, negative below it; 0 when there is none
  double share = 0;     // 0-1: its part of both lines' response
};

// At the resolution of a picture the second line is a shoulder of the first one's lobe, so the two
// sides of the lobe are compared: one line alone is as broad above as below.
SecondLine FindSecondLine(std::span<const HeightView> views, double floor_z,
                          const DistanceBins& bins, const PlaneViterbiOptions& viterbi,
                          const HeightOptions& options, RunContext& context) {
  const int reach = static_cast<int>(std::lround(options.max_baseboard_m / kBaseboardStep_m));
  std::vector<double> heights;
  for (int i = -reach; i <= reach; ++i) heights.push_back(i * kBaseboardStep_m);
  const std::vector<double> response =
      ResponseAboutFloor(views, floor_z, heights, bins, viterbi, context);
  const auto [lowest, highest] = std::minmax_element(response.begin(), response.end());
  const double rise = *highest - *lowest;
  const auto at = [&](int step) { return response[static_cast<size_t>(reach + step)]; };
  std::vector<double> excess, height;  // of what is above the line over what is below it
  for (int i = static_cast<int>(std::ceil(kMinShoulder_m / kBaseboardStep_m)); i <= reach; ++i) {
    excess.push_back(at(i) - at(-i));
    height.push_back(i * kBaseboardStep_m);
  }
  const double sum = std::accumulate(excess.begin(), excess.end(), 0.0);
  if (std::abs(sum) <= kMinShoulder * rise * static_cast<double>(excess.size())) return {};
  const int sign = sum > 0 ? 1 : -1;
  for (double& value : excess) value *= sign;
  const int peak = static_cast<int>(std::lround(height[ArgMax(excess)] / kBaseboardStep_m));
  const double second = at(sign * peak) - *lowest;
  return {sign * PeakPosition(excess, height), second / (second + rise)};
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
      ScoreFloors(views, floors, {}, prior_camera_m, bins, viterbi, options, context);
  FloorEstimate estimate{PeakPosition(scores, floors), {}, scores[ArgMax(scores)] - Median(scores)};

  const SecondLine second =
      FindSecondLine(views, estimate.floor_z, bins, viterbi, options, context);
  const bool is_below = second.height_m < 0;
  Baseboard& baseboard = estimate.baseboard;
  // Where the upper edge won both must count, or the floor line would hardly do; a joint between
  // tiles has no second line.
  baseboard = {std::abs(second.height_m), is_below ? 0.5 : second.share};
  // The stronger line won the search. When that is the upper one, a floor that was found from the
  // pictures lies lower. One that was known does not: then the walls were too far, and the lower
  // line seemed to lie deeper than it does.
  if (is_below && prior_camera_m <= 0) estimate.floor_z += second.height_m;
  if (is_below && prior_camera_m > 0) baseboard.height_m /= 1 - second.height_m / prior_camera_m;

  // Once both lines are known, their height where they agree best with the correlation.
  floors.clear();
  for (double offset = -kRefineReach_m; offset <= kRefineReach_m + 1e-9; offset += kRefineStep_m) {
    floors.push_back(estimate.floor_z + offset);
  }
  const std::vector<double> refined = ScoreFloors(views, floors, estimate.baseboard, prior_camera_m,
                                                  bins, viterbi, options, context);
  estimate.floor_z = PeakPosition(refined, floors);
  return estimate;
}

std::vector<CeilingEstimate> EstimateCeilings(std::span<const HeightView> views,
                                              const FloorEstimate& floor,
                                              const std::vector<std::vector<RoomMate>>& room_mates,
                                              const ObstacleOptions* obstacle,
                                              const DistanceBins& bins,
                                              const PlaneViterbiOptions& viterbi,
                                              const HeightOptions& options, RunContext& context) {
  ENFILADE_CHECK(room_mates.size() == views.size());
  const std::vector<double> heights = CeilingCandidates(options);
  const size_t num_heights = heights.size();
  std::vector<ColumnScores> below;
  for (const HeightView& view : views) {
    const ColumnScores line = FloorLineScores(view, floor.floor_z, floor.baseboard, bins);
    below.push_back(obstacle != nullptr ? AllowObstacles(line, bins, *obstacle) : line);
    AddScores(*view.correlation, kCorrelationFactor, below.back());
  }
  std::vector<std::vector<double>> curves(views.size(), std::vector<double>(num_heights));
  ParallelFor(context, "ceiling heights", static_cast<int64_t>(views.size() * num_heights),
              [&](int64_t i) {
                const size_t v = static_cast<size_t>(i) / num_heights,
                             h = static_cast<size_t>(i) % num_heights;
                const double ceiling_z = floor.floor_z + heights[h];
                if (ceiling_z < views[v].position.z() + 0.2) return;
                ColumnScores scores = below[v];
                AddScores(ScoreLine(*views[v].response, views[v].position.z() - ceiling_z, bins),
                          1.0, scores);
                curves[v][h] = BestPath(scores, bins, viterbi).score;
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
    double num_views = 1;
    for (const RoomMate& mate : room_mates[v]) {
      const std::vector<double>& curve = curves[static_cast<size_t>(mate.view)];
      for (size_t h = 0; h < num_heights; ++h) room[h] += mate.weight * curve[h];
      num_views += mate.weight;
    }
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
