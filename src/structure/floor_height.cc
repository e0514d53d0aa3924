// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "enfilade/base/check.h"
#include "enfilade/base/median.h"
#include "enfilade/structure/heights.h"
#include "enfilade/structure/shared_scores.h"
#include "src/structure/height_scores.h"

namespace enfilade {
namespace {

// Other panoramas know the distance too.
constexpr double kShareFactor = 2.0;
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

double MedianCameraZ(std::span<const HeightView> views) {
  std::vector<double> z;
  for (const HeightView& view : views) z.push_back(view.position.z());
  return UpperMedian(std::move(z));
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
    estimate_.contrast = scores[ArgMax(scores)] - UpperMedian(scores);
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

}  // namespace

FloorEstimate EstimateFloor(std::span<const HeightView> views, double prior_camera_m,
                            const DistanceBins& bins, const PlaneViterbiOptions& viterbi,
                            const HeightOptions& options, RunContext& context) {
  ENFILADE_CHECK(!views.empty());
  return FloorSearch(views, prior_camera_m, bins, viterbi, options, context).Run();
}

}  // namespace enfilade
