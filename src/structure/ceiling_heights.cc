// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "enfilade/base/check.h"
#include "enfilade/base/median.h"
#include "enfilade/structure/heights.h"
#include "src/structure/height_scores.h"

namespace enfilade {
namespace {

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
      medians_.push_back(UpperMedian(curve));
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
