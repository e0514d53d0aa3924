// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/shared_scores.h"

#include <algorithm>
#include <cmath>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/structure/types.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

// A panorama sees past a point at this share of its wall's distance, less the margin.
constexpr double kPastShare = 0.9;
// Response of the ceiling line at which a wall is certain to reach the ceiling.
constexpr double kClearCeiling = 0.5;

// The strongest score of `family` that a panorama gives to the points of the ray from `near` to
// `far`; negative when they lie outside its bins.
double StrongestBetween(const PlacedScores& view, int family, const Vector2d& near,
                        const Vector2d& middle, const Vector2d& far, const DistanceBins& bins) {
  const ImageF& score = view.scores->family[static_cast<size_t>(family)];
  const Vector2d ray = middle - view.position;
  const int column = ColumnOf(ray, score.rows());
  const double center = bins.Bin(ray.norm());
  const double half = 0.5 * std::abs(bins.Bin((far - view.position).norm()) -
                                     bins.Bin((near - view.position).norm()));
  const int b0 = static_cast<int>(std::floor(center));
  if (b0 < 0 || b0 + 1 >= bins.count) return -1;
  const double a = center - b0;
  double best = (1 - a) * score(column, b0) + a * score(column, b0 + 1);
  const int first = std::max(0, static_cast<int>(std::ceil(center - half))),
            last = std::min(bins.count - 1, static_cast<int>(std::floor(center + half)));
  for (int b = first; b <= last; ++b) best = std::max<double>(best, score(column, b));
  return best;
}

// Asks other panoramas about the walls that one panorama supposes.
class Sharer {
 public:
  Sharer(std::span<const PlacedScores> views, int self, std::span<const int> others,
         std::span<const KnownDistances> known, const ColumnScores* own_ceiling,
         const DistanceBins& bins, const SharedScoresOptions& options)
      : views_(views),
        own_position_(views[static_cast<size_t>(self)].position),
        own_ceiling_(own_ceiling),
        others_(others),
        known_(known),
        bins_(bins),
        options_(options) {
    ENFILADE_CHECK(known.size() == views.size());
  }

  [[nodiscard]] double Score(double azimuth, int family, double bin) const {
    const Vector2d ray(std::cos(azimuth), std::sin(azimuth));
    const double direction = WallDirection(family, azimuth);
    const Vector2d normal(-std::sin(direction), std::cos(direction));
    if (std::abs(normal.dot(ray)) < kMinIncidenceSin) return 0;
    const Vector2d middle = own_position_ + bins_.Distance(bin) * ray,
                   near = own_position_ + bins_.Distance(bin - 0.5) * ray,
                   far = own_position_ + bins_.Distance(bin + 0.5) * ray;
    double support = 0;
    int num_supporting = 0, num_seeing_past = 0;
    for (const int other : others_) {
      if (num_supporting + num_seeing_past >= options_.max_views) break;
      const PlacedScores& view = views_[static_cast<size_t>(other)];
      const KnownDistances& known = known_[static_cast<size_t>(other)];
      if (SeesPast(middle, view.position, known)) {
        ++num_seeing_past;
        continue;
      }
      if (!WouldSee({middle, normal, own_position_}, view.position, known,
                    options_.max_view_distance_m))
        continue;
      const double strongest = StrongestBetween(view, family, near, middle, far, bins_);
      if (strongest < 0) continue;
      support += strongest;
      ++num_supporting;
    }
    double score = num_supporting > 0 ? support / num_supporting : 0;
    if (num_seeing_past > 0) {
      score -= options_.contradiction * num_seeing_past / (num_supporting + num_seeing_past) *
               (1 - std::min(1.0, CeilingResponse(azimuth, family, bin) / kClearCeiling));
    }
    return score;
  }

 private:
  // Whether a panorama sees well past a point, to a wall behind it.
  [[nodiscard]] bool SeesPast(const Vector2d& point, const Vector2d& position,
                              const KnownDistances& known) const {
    const double range = (point - position).norm();
    return options_.contradiction > 0 && !known.empty() && range < options_.max_view_distance_m &&
           range < kPastShare * DistanceTowards(known, point - position) - options_.past_margin_m;
  }

  [[nodiscard]] double CeilingResponse(double azimuth, int family, double bin) const {
    if (own_ceiling_ == nullptr) return 0;
    const ImageF& response = own_ceiling_->family[static_cast<size_t>(family)];
    const int column = ColumnOf(Vector2d(std::cos(azimuth), std::sin(azimuth)), response.rows());
    const int center = static_cast<int>(std::lround(bin));
    float best = 0;
    for (int b = std::max(0, center - 1); b <= std::min(bins_.count - 1, center + 1); ++b)
      best = std::max(best, response(column, b));
    return best;
  }

  std::span<const PlacedScores> views_;
  Vector2d own_position_;
  const ColumnScores* own_ceiling_;
  std::span<const int> others_;
  std::span<const KnownDistances> known_;
  const DistanceBins& bins_;
  const SharedScoresOptions& options_;
};

}  // namespace

ColumnScores ShareScores(std::span<const PlacedScores> views, int self, std::span<const int> others,
                         std::span<const KnownDistances> known, const ColumnScores* own_ceiling,
                         int column_step, const DistanceBins& bins,
                         const SharedScoresOptions& options) {
  ENFILADE_CHECK(column_step >= 1);
  const Sharer sharer(views, self, others, known, own_ceiling, bins, options);
  const ColumnScores& own = *views[static_cast<size_t>(self)].scores;
  ColumnScores shared;
  for (int f = 0; f < kNumPlaneFamilies; ++f) {
    const int num_columns = own.family[static_cast<size_t>(f)].rows();
    if (num_columns == 0) continue;
    ImageF score(num_columns, bins.count);
    for (int c = 0; c < num_columns; c += column_step) {
      const double azimuth =
          AzimuthOfColumn(c, num_columns) + (column_step - 1) * kPi / num_columns;
      for (int b = 0; b < bins.count; ++b)
        score(c, b) = static_cast<float>(sharer.Score(azimuth, f, b));
      for (int i = c + 1; i < std::min(c + column_step, num_columns); ++i)
        std::copy_n(score.row(c), bins.count, score.row(i));
    }
    shared.family[static_cast<size_t>(f)] = std::move(score);
  }
  return shared;
}

double ShareOfPath(std::span<const PlacedScores> views, int self, const WallPath& path,
                   std::span<const int> others, std::span<const KnownDistances> known,
                   const DistanceBins& bins, const SharedScoresOptions& options) {
  const Sharer sharer(views, self, others, known, nullptr, bins, options);
  const int num_columns = static_cast<int>(path.wall_m.size());
  double sum = 0;
  for (int c = 0; c < num_columns; ++c) {
    const size_t i = static_cast<size_t>(c);
    sum += sharer.Score(AzimuthOfColumn(c, num_columns), path.family[i], bins.Bin(path.wall_m[i]));
  }
  return sum / num_columns;
}

}  // namespace enfilade
