// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/heights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

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
constexpr double kRefineReach_m = 0.04;
constexpr double kRefineStep_m = 0.01;
// Heights of baseboards are tried in such steps, from so many on, together with the floor's.
constexpr double kBaseboardStep_m = 0.01;
constexpr int kLowestBaseboard = 5;
// So far beyond the line that was found, and the line below it, the floor is sought again.
constexpr double kBaseboardSlack_m = 0.02;
constexpr double kBaseboardFloorStep_m = 0.02;
// What a baseboard must gain, as a share of the score.
constexpr double kMinBaseboardGain = 0.01;
// Only near walls resolve the two lines.
constexpr double kBaseboardReach_m = 2.2;
// Steps by which a column may be off its wall's line; response from which there is a line at all.
constexpr int kAlignSteps = 5;
constexpr double kMinLineResponse = 0.3;
// One side of the line's lobe must exceed the other, in the mean from here on, by this share of the
// line's response.
constexpr double kMinShoulder_m = 0.07;
constexpr double kMinShoulder = 0.03;
// The most that a room mate counts against a ceiling, mean response: a ceiling that one panorama
// sees clearly gains more over any other.
constexpr double kMateLoss = 0.1;
// No ceiling is nearer above a camera.
constexpr double kLeastAbove_m = 0.2;
// Panoramas whose ceilings differ by less have the same one.
constexpr double kSameCeiling_m = 0.05;
// Heights of cornices are tried in such steps, from the first on, with the line that was found as
// any of their edges.
constexpr double kLowestCornice_m = 0.05;
constexpr double kCorniceStep_m = 0.02;
constexpr double kCorniceSlack_m = 0.06;
// What the mean of a cornice's two edges has of the response to the stronger one: with a half there
// is one line alone.
constexpr double kMinCorniceShare = 0.65;
// And what the stronger one must have, mean response: less is chance.
constexpr double kMinCorniceLine = 0.1;

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

double Median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

double MedianCameraZ(std::span<const HeightView> views) {
  std::vector<double> z;
  for (const HeightView& view : views) z.push_back(view.position.z());
  return Median(std::move(z));
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

// Where pictures do not part the two lines the second one is a shoulder of the first one's lobe: a
// line alone is as broad above as below. The number of steps to the second line, if there is one.
std::optional<int> ShoulderOfLine(const std::vector<double>& response) {
  const int reach = static_cast<int>(response.size()) / 2;
  const auto at = [&](int step) { return response[static_cast<size_t>(reach + step)]; };
  const int nearest = static_cast<int>(std::lround(kMinShoulder_m / kBaseboardStep_m));
  std::vector<double> excess;  // of what is above the line over what is below it
  for (int i = nearest; i <= reach; ++i) excess.push_back(at(i) - at(-i));
  const double sum = std::accumulate(excess.begin(), excess.end(), 0.0);
  if (std::abs(sum) <= kMinShoulder * at(0) * static_cast<double>(excess.size()))
    return std::nullopt;
  if (sum < 0) {
    for (double& value : excess) value = -value;
  }
  return nearest + static_cast<int>(ArgMax(excess));
}

// The baseboard, in steps, whose score stands out; none when there is a single line. Then
// scores only fall as the two lines part, so a baseboard is what stands out above the straight line
// from the lowest to the tallest. Paths change by leaps: neighbours are averaged.
std::optional<int> BaseboardThatStandsOut(const std::vector<double>& scores) {
  if (scores.size() < 3) return std::nullopt;
  const size_t last = scores.size() - 1;
  std::vector<double> smooth;
  for (size_t i = 0; i <= last; ++i)
    smooth.push_back((scores[i > 0 ? i - 1 : 0] + 2 * scores[i] + scores[std::min(i + 1, last)]) /
                     4);
  std::vector<double> gain;
  for (size_t i = 0; i <= last; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(last);
    gain.push_back(smooth[i] - (1 - share) * smooth.front() - share * smooth.back());
  }
  const size_t best = ArgMax(gain);
  if (gain[best] <= kMinBaseboardGain * smooth[best]) return std::nullopt;
  return kLowestBaseboard + static_cast<int>(best);
}

class FloorSearch {
 public:
  FloorSearch(std::span<const HeightView> views, double prior_camera_m, const DistanceBins& bins,
              const PlaneViterbiOptions& viterbi, const HeightOptions& options, RunContext& context)
      : views_(views),
        prior_camera_m_(prior_camera_m),
        bins_(bins),
        viterbi_(viterbi),
        options_(options),
        context_(context),
        median_z_(MedianCameraZ(views)),
        tallest_(static_cast<int>(std::lround(options.max_baseboard_m / kBaseboardStep_m))) {
    std::vector<Eigen::Vector2d> positions;
    for (const HeightView& view : views) positions.push_back(view.position.head<2>());
    for (size_t v = 0; v < views.size(); ++v) others_.push_back(NearestOthers(positions, v));
  }

  FloorEstimate Run() {
    FindLine();
    FindBaseboard();
    Refine();
    return estimate_;
  }

 private:
  void FindLine() {
    const double reach = 3 * options_.camera_prior_sigma_m;
    const double low = prior_camera_m_ > 0 ? prior_camera_m_ - reach : options_.min_camera_m;
    const double high = prior_camera_m_ > 0 ? prior_camera_m_ + reach : options_.max_camera_m;
    const std::vector<double> floors = FloorsBelow(low, high, options_.step_m);
    const std::vector<double> scores = Score(floors, {});
    estimate_.floor_z = PeakPosition(scores, floors);
    estimate_.contrast = scores[ArgMax(scores)] - Median(scores);
  }

  // The line that was found may be either edge of a baseboard: the floor is at it or below.
  void FindBaseboard() {
    const double found_m = median_z_ - estimate_.floor_z;
    std::vector<double> pair_scores, pair_floors;
    for (int b = kLowestBaseboard; b <= tallest_; ++b) {
      const double height_m = b * kBaseboardStep_m;
      const std::vector<double> floors =
          FloorsBelow(found_m - kBaseboardSlack_m, found_m + height_m + kBaseboardSlack_m,
                      kBaseboardFloorStep_m);
      const std::vector<double> scores = Score(floors, {height_m, 0.5});
      pair_scores.push_back(scores[ArgMax(scores)]);
      pair_floors.push_back(floors[ArgMax(scores)]);
    }
    const std::vector<double> response = ResponseAboutLine();
    std::optional<int> steps = BaseboardThatStandsOut(pair_scores);
    if (!steps) steps = ShoulderOfLine(response);
    if (!steps) return;
    // More shows below the line that was found when it is the upper edge: then both count alike, or
    // the floor line would hardly do.
    const auto shown = [&](int step) { return response[static_cast<size_t>(tallest_ + step)]; };
    const double share = shown(-*steps) >= shown(*steps)
                             ? 0.5
                             : std::min(0.5, shown(*steps) / (shown(0) + shown(*steps)));
    estimate_.baseboard = {*steps * kBaseboardStep_m, share};
    estimate_.floor_z = pair_floors[static_cast<size_t>(*steps - kLowestBaseboard)];
  }

  void Refine() {
    const double camera_m = median_z_ - estimate_.floor_z;
    const std::vector<double> floors =
        FloorsBelow(camera_m - kRefineReach_m, camera_m + kRefineReach_m, kRefineStep_m);
    estimate_.floor_z = PeakPosition(Score(floors, estimate_.baseboard), floors);
  }

  // Floors from `low` to `high` metres below the median camera.
  [[nodiscard]] std::vector<double> FloorsBelow(double low, double high, double step) const {
    std::vector<double> floors;
    for (double h = low; h <= high + 1e-9; h += step) floors.push_back(median_z_ - h);
    return floors;
  }

  // The score of each floor height, with the log prior on the camera height.
  [[nodiscard]] std::vector<double> Score(const std::vector<double>& floors,
                                          const Baseboard& baseboard) const {
    std::vector<double> scores(floors.size());
    ParallelFor(context_, "floor height", static_cast<int64_t>(floors.size()), [&](int64_t i) {
      const size_t h = static_cast<size_t>(i);
      const double camera_m = median_z_ - floors[h];
      const double loss =
          prior_camera_m_ > 0
              ? PriorLoss(camera_m, prior_camera_m_, options_.camera_prior_sigma_m)
              : PriorLoss(camera_m, options_.typical_camera_m, options_.typical_camera_sigma_m);
      scores[h] = FloorScore(views_, others_, floors[h], baseboard, bins_, viterbi_) - loss;
    });
    return scores;
  }

  // Mean response along the near walls that a single floor line finds, by steps of height about
  // that line: tallest_ steps below it, itself, tallest_ above. Each column is aligned at its own
  // strongest response, as a wall is found but to a few centimetres.
  [[nodiscard]] std::vector<double> ResponseAboutLine() const {
    struct Sum {
      std::vector<double> response;
      int count = 0;
    };
    const int length = 2 * tallest_ + 1;
    std::vector<Sum> sums(views_.size(), {std::vector<double>(static_cast<size_t>(length)), 0});
    ParallelFor(context_, "baseboard", static_cast<int64_t>(views_.size()), [&](int64_t i) {
      const HeightView& view = views_[static_cast<size_t>(i)];
      ColumnScores scores = FloorLineScores(view, estimate_.floor_z, {}, bins_);
      AddScores(*view.correlation, 1.0, scores);
      const WallPath path = BestPath(scores, bins_, viterbi_);
      std::vector<ColumnScores> lines;
      for (int k = -tallest_ - kAlignSteps; k <= tallest_ + kAlignSteps; ++k) {
        const double floor_m = view.position.z() - estimate_.floor_z;
        lines.push_back(ScoreLine(*view.response, floor_m - k * kBaseboardStep_m, bins_));
      }
      Sum& sum = sums[static_cast<size_t>(i)];
      for (size_t c = 0; c < path.wall_m.size(); ++c) {
        if (path.wall_m[c] > kBaseboardReach_m) continue;
        const int bin = bins_.NearestBin(path.wall_m[c]);
        std::vector<double> response;
        for (const ColumnScores& line : lines) {
          response.push_back(
              line.family[static_cast<size_t>(path.family[c])](static_cast<int>(c), bin));
        }
        const auto first = response.begin() + tallest_;
        const auto peak = std::max_element(first, first + 2 * kAlignSteps + 1);
        if (*peak < kMinLineResponse) continue;
        for (int k = 0; k < length; ++k)
          sum.response[static_cast<size_t>(k)] += *(peak - tallest_ + k);
        ++sum.count;
      }
    });
    Sum total = sums.front();
    for (size_t i = 1; i < sums.size(); ++i) {
      for (size_t k = 0; k < total.response.size(); ++k) total.response[k] += sums[i].response[k];
      total.count += sums[i].count;
    }
    for (double& value : total.response) value /= std::max(1, total.count);
    return total.response;
  }

  std::span<const HeightView> views_;
  double prior_camera_m_;
  const DistanceBins& bins_;
  const PlaneViterbiOptions& viterbi_;
  const HeightOptions& options_;
  RunContext& context_;
  double median_z_;
  int tallest_;  // baseboard, in steps
  std::vector<std::vector<int>> others_;
  FloorEstimate estimate_;
};

// Ceiling heights above the floor that are tried.
std::vector<double> CeilingCandidates(const HeightOptions& options) {
  std::vector<double> heights;
  for (double h = options.min_room_m; h <= options.max_room_m; h += options.step_m)
    heights.push_back(h);
  return heights;
}

// How well each height of the ceiling explains the panoramas, and which height each has.
class CeilingFinder {
 public:
  CeilingFinder(std::span<const HeightView> views, const FloorEstimate& floor,
                const std::vector<std::vector<RoomMate>>& room_mates,
                const ObstacleOptions* obstacle, const DistanceBins& bins,
                const PlaneViterbiOptions& viterbi, const HeightOptions& options,
                RunContext& context)
      : views_(views),
        floor_(floor),
        room_mates_(room_mates),
        bins_(bins),
        viterbi_(viterbi),
        options_(options),
        context_(context),
        heights_(CeilingCandidates(options)) {
    for (const HeightView& view : views) {
      const ColumnScores line = FloorLineScores(view, floor.floor_z, floor.baseboard, bins);
      below_.push_back(obstacle != nullptr ? AllowObstacles(line, bins, *obstacle) : line);
      AddScores(*view.correlation, kCorrelationFactor, below_.back());
    }
  }

  [[nodiscard]] std::vector<CeilingEstimate> Find() {
    ScoreHeights();
    std::vector<size_t> found;  // of each panorama, into heights_
    std::vector<CeilingEstimate> estimates;
    for (size_t v = 0; v < views_.size(); ++v) {
      const std::vector<double> pooled = Pooled(v);
      found.push_back(ArgMax(pooled));
      const double contrast = Contrast(v, found.back());
      context_.log().Debug(fmt::format("ceiling {:.2f} m above the floor, contrast {:.3f}",
                                       heights_[found.back()], contrast));
      const double line_z = floor_.floor_z + PeakPosition(pooled, heights_);
      estimates.push_back(
          {line_z, line_z, 0, std::clamp(contrast / options_.level_contrast, 0.0, 1.0)});
    }
    FindCornices(found, estimates);
    return estimates;
  }

 private:
  // Mean response along the best path of a panorama under a ceiling with a cornice or without.
  [[nodiscard]] double Score(size_t v, double height_m, double cornice_m) const {
    const double above_m = floor_.floor_z + height_m - views_[v].position.z();
    if (above_m < kLeastAbove_m) return 0;
    ColumnScores scores = below_[v];
    AddScores(ScoreCeiling(*views_[v].response, above_m, cornice_m, bins_), 1.0, scores);
    return BestPath(scores, bins_, viterbi_).score;
  }

  // For each panorama what each height gains over the median one, and the mean of that over all.
  void ScoreHeights() {
    const size_t num_heights = heights_.size();
    curves_.assign(views_.size(), std::vector<double>(num_heights));
    ParallelFor(context_, "ceiling heights", static_cast<int64_t>(views_.size() * num_heights),
                [&](int64_t i) {
                  const size_t v = static_cast<size_t>(i) / num_heights,
                               h = static_cast<size_t>(i) % num_heights;
                  curves_[v][h] = Score(v, heights_[h], 0);
                });
    home_.assign(num_heights, 0);
    for (std::vector<double>& curve : curves_) {
      medians_.push_back(Median(curve));
      for (size_t h = 0; h < num_heights; ++h) {
        curve[h] = std::max(0.0, curve[h] - medians_.back());
        home_[h] += curve[h] / static_cast<double>(curves_.size());
      }
      peaks_.push_back(*std::max_element(curve.begin(), curve.end()));
    }
  }

  // What a room mate has against a height.
  [[nodiscard]] double MateLoss(const RoomMate& mate, size_t h) const {
    const auto m = static_cast<size_t>(mate.view);
    return std::min(peaks_[m] - curves_[m][h], kMateLoss);
  }

  // The panoramas that count for one's ceiling, by their weights.
  [[nodiscard]] double NumViews(size_t v) const {
    double num_views = 1;
    for (const RoomMate& mate : room_mates_[v]) num_views += mate.weight;
    return num_views;
  }

  // What a height loses because rooms usually measure otherwise.
  [[nodiscard]] double UnusualLoss(size_t h) const {
    return PriorLoss(heights_[h], options_.typical_room_m, options_.typical_room_sigma_m);
  }

  [[nodiscard]] std::vector<double> Pooled(size_t v) const {
    const double num_views = NumViews(v);
    std::vector<double> pooled = curves_[v];
    for (size_t h = 0; h < pooled.size(); ++h) {
      for (const RoomMate& mate : room_mates_[v]) pooled[h] -= mate.weight * MateLoss(mate, h);
      pooled[h] += options_.home_weight * home_[h] - num_views * UnusualLoss(h);
    }
    return pooled;
  }

  // How far a height stands out, in the mean over all that may have it.
  [[nodiscard]] double Contrast(size_t v, size_t h) const {
    const double num_views = NumViews(v);
    double sum = curves_[v][h] + options_.home_weight * home_[h];
    for (const RoomMate& mate : room_mates_[v])
      sum += mate.weight * curves_[static_cast<size_t>(mate.view)][h];
    return (sum - num_views * UnusualLoss(h)) / (num_views + options_.home_weight);
  }

  // Where both edges of a cornice show, the line that was found is one of them, or lies between.
  void FindCornices(const std::vector<size_t>& found, std::vector<CeilingEstimate>& estimates) {
    for (double size = kLowestCornice_m; size <= options_.max_cornice_m; size += kCorniceStep_m)
      cornices_.push_back(size);
    if (cornices_.empty()) return;
    // Of each panorama and size a curve over the height: 0 where no cornice can be.
    edges_.assign(views_.size() * cornices_.size(), std::vector<double>(heights_.size()));
    const double slack_m = kCorniceSlack_m + kSameCeiling_m;
    ParallelFor(context_, "cornices", static_cast<int64_t>(views_.size() * heights_.size()),
                [&](int64_t i) {
                  const size_t v = static_cast<size_t>(i) / heights_.size(),
                               h = static_cast<size_t>(i) % heights_.size();
                  const double off_m = heights_[h] - heights_[found[v]];
                  if (off_m < -slack_m || off_m > slack_m + options_.max_cornice_m) return;
                  for (size_t s = 0; s < cornices_.size(); ++s) {
                    edges_[v * cornices_.size() + s][h] =
                        std::max(0.0, Score(v, heights_[h], cornices_[s]) - medians_[v]);
                  }
                });
    for (size_t v = 0; v < views_.size(); ++v) FitCornice(v, found, estimates[v]);
  }

  // Compares the mean response to both edges, pooled over the panoramas under the same ceiling,
  // with that to a single line near there.
  void FitCornice(size_t v, const std::vector<size_t>& found, CeilingEstimate& estimate) const {
    std::vector<RoomMate> members = {{static_cast<int>(v), 1}};
    for (const RoomMate& mate : room_mates_[v]) {
      const double off_m = heights_[found[static_cast<size_t>(mate.view)]] - heights_[found[v]];
      if (std::abs(off_m) < kSameCeiling_m) members.push_back(mate);
    }
    double num_members = 0, line = 0;
    for (const RoomMate& member : members) num_members += member.weight;
    for (size_t h = 0; h < heights_.size(); ++h) {
      if (std::abs(heights_[h] - heights_[found[v]]) > options_.max_cornice_m) continue;
      double sum = 0;
      for (const RoomMate& member : members)
        sum += member.weight * curves_[static_cast<size_t>(member.view)][h];
      line = std::max(line, sum);
    }
    if (line < kMinCorniceLine * num_members) return;
    double best = kMinCorniceShare * line;
    for (size_t s = 0; s < cornices_.size(); ++s) {
      std::vector<double> pooled(heights_.size());
      for (const RoomMate& member : members) {
        const size_t i = static_cast<size_t>(member.view) * cornices_.size() + s;
        for (size_t h = 0; h < pooled.size(); ++h) pooled[h] += member.weight * edges_[i][h];
      }
      const double peak = pooled[ArgMax(pooled)];
      if (peak <= best) continue;
      best = peak;
      estimate.cornice_m = cornices_[s];
      estimate.ceiling_z = floor_.floor_z + PeakPosition(pooled, heights_);
    }
  }

  std::span<const HeightView> views_;
  const FloorEstimate& floor_;
  const std::vector<std::vector<RoomMate>>& room_mates_;
  const DistanceBins& bins_;
  const PlaneViterbiOptions& viterbi_;
  const HeightOptions& options_;
  RunContext& context_;
  std::vector<double> heights_;              // above the floor
  std::vector<ColumnScores> below_;          // all but the ceiling's, a panorama each
  std::vector<std::vector<double>> curves_;  // gain over the median height
  std::vector<double> medians_, peaks_;      // of the curves
  std::vector<double> home_;                 // mean curve
  std::vector<double> cornices_;             // heights of cornices that are tried
  std::vector<std::vector<double>> edges_;   // views × cornices: gain of both edges
};

}  // namespace

FloorEstimate EstimateFloor(std::span<const HeightView> views, double prior_camera_m,
                            const DistanceBins& bins, const PlaneViterbiOptions& viterbi,
                            const HeightOptions& options, RunContext& context) {
  ENFILADE_CHECK(!views.empty());
  return FloorSearch(views, prior_camera_m, bins, viterbi, options, context).Run();
}

std::vector<CeilingEstimate> EstimateCeilings(std::span<const HeightView> views,
                                              const FloorEstimate& floor,
                                              const std::vector<std::vector<RoomMate>>& room_mates,
                                              const ObstacleOptions* obstacle,
                                              const DistanceBins& bins,
                                              const PlaneViterbiOptions& viterbi,
                                              const HeightOptions& options, RunContext& context) {
  ENFILADE_CHECK(room_mates.size() == views.size());
  CeilingFinder finder(views, floor, room_mates, obstacle, bins, viterbi, options, context);
  return finder.Find();
}

}  // namespace enfilade
