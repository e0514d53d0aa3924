// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/two_view.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "enfilade/base/median.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/geometry/rigid3.h"
#include "src/sfm/feature_sizes.h"
#include "src/sfm/landscape.h"
#include "src/sfm/upright_votes.h"

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// A match: its rays and how much it counts.
struct RayPair {
  Vector3d first, second;
  double weight = 1;
  // At unit distance.
  double first_log_size = kUnknown, second_log_size = kUnknown;
};

constexpr int kMinMatches = 8;
// Matches count fully from this parallax on: those with less agree with many directions.
constexpr double kFullParallax_rad = DegToRad(2);
constexpr int kRefinements = 8;
constexpr double kYawReach_rad = DegToRad(5);
constexpr double kHeadingTolerance_rad = DegToRad(4);
// What a match counts where the yaw is at odds with the walls.
constexpr double kOffHeadingShare = 0.5;
constexpr int kShifts = 7;
// Rotations alone are told to this angle; so many of the agreeing matches make it one place.
constexpr double kOneSpot_rad = DegToRad(1.5);
constexpr double kSamePlace_rad = DegToRad(3.0);
constexpr double kSamePlaceShare = 0.8, kTurnedShare = 0.3;
constexpr int kSamePlaceSectors = 5;
// Rays lower than this mostly end on the floor.
constexpr double kFloorSlope = -0.3, kFloorWeight = 0.4;
constexpr double kFarParallax_rad = DegToRad(8);
constexpr double kFarLog10Chance = -25;

double Parallax(const TwoViewGeometry& geometry, const RayPair& rays) {
  const Vector3d b = geometry.a_from_b * rays.second;
  return std::atan2(rays.first.cross(b).norm(), rays.first.dot(b));
}

bool Agrees(const TwoViewGeometry& geometry, const RayPair& rays, double bound_rad) {
  if (std::abs(EpipolarError(geometry, rays.first, rays.second)) > bound_rad) return false;
  double depth_ratio = 1;
  if (Parallax(geometry, rays) >= bound_rad) {  // less is as far away as can be told
    const PairDepths depths = TriangulateDepths(geometry, rays.first, rays.second);
    if (depths.a <= 0 || depths.b <= 0) return false;
    depth_ratio = depths.b / depths.a;
  }
  return FitSizes(rays.first_log_size, rays.second_log_size, depth_ratio);
}

double Weight(const TwoViewGeometry& geometry, const RayPair& rays) {
  return rays.weight * std::min(1.0, Parallax(geometry, rays) / kFullParallax_rad);
}

double TurnOf(const RayPair& rays) {
  return std::atan2(rays.first.y(), rays.first.x()) - std::atan2(rays.second.y(), rays.second.x());
}

// Matches of one spot, from one feature at several scales or in several views, count as one: if one
// of them is false, all are. Those of floors count less: where one joint of tiles or boards lies on
// another, the others do so as well.
void ShareWeights(std::vector<RayPair>& matches) {
  std::vector<int> num_near(matches.size(), 0);
  for (size_t i = 0; i < matches.size(); ++i) {
    for (const RayPair& other : matches) {
      num_near[i] += (matches[i].first - other.first).norm() < kOneSpot_rad &&
                     (matches[i].second - other.second).norm() < kOneSpot_rad;
    }
  }
  for (size_t i = 0; i < matches.size(); ++i) {
    const bool is_low = std::min(matches[i].first.z(), matches[i].second.z()) < kFloorSlope;
    matches[i].weight = (is_low ? kFloorWeight : 1.0) / num_near[i];
  }
}

double Score(const TwoViewGeometry& geometry, std::span<const RayPair> matches, double bound_rad) {
  double score = 0;
  for (const RayPair& rays : matches) {
    if (Agrees(geometry, rays, bound_rad)) score += Weight(geometry, rays);
  }
  return score;
}

// Two unit vectors orthogonal to `direction`: level and upward.
std::pair<Vector3d, Vector3d> Tangents(const Vector3d& direction) {
  Vector3d level = Vector3d::UnitZ().cross(direction);
  if (level.norm() < 1e-6) level = Vector3d::UnitX();
  level.normalize();
  return {level, direction.cross(level)};
}

TwoViewGeometry Moved(const TwoViewGeometry& geometry, const Eigen::Matrix<double, 5, 1>& step) {
  const Vector3d omega = step.head<3>();
  const Matrix3d turn =
      omega.norm() < 1e-15 ? Matrix3d::Identity()
                           : Eigen::AngleAxisd(omega.norm(), omega.normalized()).toRotationMatrix();
  const auto [level, upward] = Tangents(geometry.direction);
  return {turn * geometry.a_from_b,
          (geometry.direction + step[3] * level + step[4] * upward).normalized()};
}

// The priors of the upright model as residuals in standard deviations: lean about x and y, slope.
Vector3d PriorResiduals(const TwoViewGeometry& geometry, const TwoViewOptions& options) {
  const Vector3d lean = geometry.a_from_b.col(2);
  const double tilt = std::sqrt(2.0) * DegToRad(options.tilt_sigma_deg);
  return {lean.x() / tilt, lean.y() / tilt,
          geometry.direction.z() / DegToRad(options.climb_sigma_deg)};
}

// One Gauss–Newton step of the reweighted least squares over the matches that agree.
TwoViewGeometry RefineOnce(const TwoViewGeometry& geometry, std::span<const RayPair> matches,
                           double bound_rad, const TwoViewOptions& options, bool has_priors) {
  constexpr double kStep = 1e-6;
  const double scale = bound_rad / 3;
  std::array<TwoViewGeometry, 5> moved;
  for (int k = 0; k < 5; ++k) {
    moved[static_cast<size_t>(k)] = Moved(geometry, kStep * Eigen::Matrix<double, 5, 1>::Unit(k));
  }
  Eigen::Matrix<double, 5, 5> normal = 1e-9 * Eigen::Matrix<double, 5, 5>::Identity();
  Eigen::Matrix<double, 5, 1> gradient = Eigen::Matrix<double, 5, 1>::Zero();
  const auto add = [&](double residual, const Eigen::Matrix<double, 5, 1>& row, double weight) {
    normal += weight * row * row.transpose();
    gradient += weight * residual * row;
  };
  for (const RayPair& rays : matches) {
    if (!Agrees(geometry, rays, bound_rad)) continue;
    const double residual = EpipolarError(geometry, rays.first, rays.second) / scale;
    Eigen::Matrix<double, 5, 1> row;
    for (int k = 0; k < 5; ++k) {
      const double at = EpipolarError(moved[static_cast<size_t>(k)], rays.first, rays.second);
      row[k] = (at / scale - residual) / kStep;
    }
    add(residual, row, rays.weight / (1 + residual * residual));
  }
  if (has_priors) {
    const Vector3d prior = PriorResiduals(geometry, options);
    for (int i = 0; i < 3; ++i) {
      Eigen::Matrix<double, 5, 1> row;
      for (int k = 0; k < 5; ++k) {
        row[k] = (PriorResiduals(moved[static_cast<size_t>(k)], options)[i] - prior[i]) / kStep;
      }
      add(prior[i], row, 1);
    }
  }
  const Eigen::Matrix<double, 5, 1> step = -normal.ldlt().solve(gradient);
  const double limit = std::min(1.0, 0.1 / std::max(1e-12, step.norm()));
  return Moved(geometry, limit * step);
}

TwoViewGeometry Refine(TwoViewGeometry geometry, std::span<const RayPair> matches,
                       const TwoViewOptions& options, bool has_priors) {
  const double inlier_rad = DegToRad(options.inlier_deg);
  for (int i = 0; i < kRefinements; ++i) {
    // Candidates of the grid are off by up to half a step, so the first rounds look wider.
    const double bound_rad = i < 3 ? 2 * inlier_rad : inlier_rad;
    geometry = RefineOnce(geometry, matches, bound_rad, options, has_priors);
  }
  return geometry;
}

RayPair Mismatch(const RayPair& a, const RayPair& b) {
  return {a.first, b.second, 1, a.first_log_size, b.second_log_size};
}

// Share of mismatched rays that agree nevertheless: the k-th match's ray in a with others' in b.
double ChanceOfOne(const TwoViewGeometry& geometry, std::span<const RayPair> matches,
                   double bound_rad) {
  const size_t n = matches.size();
  double agreeing = 1, total = 2;
  for (size_t s = 1; s <= kShifts; ++s) {
    const size_t shift = s * n / (kShifts + 1) + 1;
    for (size_t i = 0; i < n; ++i) {
      agreeing += Agrees(geometry, Mismatch(matches[i], matches[(i + shift) % n]), bound_rad);
      total += 1;
    }
  }
  return agreeing / total;
}

// log10 of P(at least k of n) for independent events of probability p (the first term of
// Hoeffding's bound), times the number of hypotheses that were tried.
double Log10Chance(double k, double n, double p, double log10_hypotheses) {
  if (k <= n * p) return log10_hypotheses;
  const double q = k / n;
  double divergence = q * std::log(q / p);
  if (q < 1) divergence += (1 - q) * std::log((1 - q) / (1 - p));
  return log10_hypotheses - n * divergence / std::log(10.0);
}

// Log10Chance of matches that agree with a geometry by so much.
double ChanceOfScore(const TwoViewGeometry& geometry, double score,
                     std::span<const RayPair> matches, double bound_rad, double log10_hypotheses) {
  double num_spots = 0;
  for (const RayPair& rays : matches) num_spots += rays.weight;
  return Log10Chance(score, num_spots, ChanceOfOne(geometry, matches, bound_rad), log10_hypotheses);
}

bool IsTurned(const Matrix3d& rotation, const RayPair& rays) {
  return (rays.first - rotation * rays.second).norm() < kSamePlace_rad;
}

// The yaw about which most matches agree without any parallax, and how many do.
std::pair<Matrix3d, double> BestRotation(std::span<const RayPair> matches) {
  std::pair<Matrix3d, double> best{Matrix3d::Identity(), 0};
  for (const RayPair& seed : matches) {
    const Matrix3d rotation = RotationZ(TurnOf(seed));
    double count = 0;
    for (const RayPair& rays : matches) {
      count += IsTurned(rotation, rays);
    }
    if (count > best.second) best = {rotation, count};
  }
  std::vector<double> yaws;
  const double middle = YawOf(best.first);
  for (const RayPair& rays : matches) {
    if (!IsTurned(best.first, rays)) continue;
    yaws.push_back(WrapPi(TurnOf(rays) - middle));
  }
  best.first = RotationZ(middle + UpperMedian(yaws));
  return best;
}

// Of eight sectors of azimuth those in which a rotation brings at least three matches together.
// What is far away behind a window shows no parallax either, but lies in few of them.
int NumSectors(const Matrix3d& rotation, std::span<const RayPair> matches) {
  std::array<int, 8> counts{};
  for (const RayPair& rays : matches) {
    if (!IsTurned(rotation, rays)) continue;
    const double azimuth = std::atan2(rays.first.y(), rays.first.x());
    ++counts[static_cast<size_t>(std::min(7.0, (azimuth + kPi) / (2 * kPi) * 8))];
  }
  return static_cast<int>(
      std::count_if(counts.begin(), counts.end(), [](int n) { return n >= 3; }));
}

// The matches' rays with weights.
std::vector<RayPair> RaysOf(std::span<const Vector3d> level_rays_a,
                            std::span<const Vector3d> level_rays_b,
                            std::span<const FeatureMatch> matches, const PairHints& hints) {
  std::vector<RayPair> rays;
  for (const FeatureMatch& match : matches) {
    const auto a = static_cast<size_t>(match.a_idx), b = static_cast<size_t>(match.b_idx);
    RayPair pair_of_rays{level_rays_a[a], level_rays_b[b]};
    if (a < hints.log_sizes_a.size() && b < hints.log_sizes_b.size()) {
      pair_of_rays.first_log_size = hints.log_sizes_a[a];
      pair_of_rays.second_log_size = hints.log_sizes_b[b];
    }
    rays.push_back(pair_of_rays);
  }
  ShareWeights(rays);
  return rays;
}

std::vector<size_t> NotOfLandscape(std::span<const RayPair> rays) {
  std::vector<Vector3d> rays_a, rays_b;
  for (const RayPair& pair_of_rays : rays) {
    rays_a.push_back(pair_of_rays.first);
    rays_b.push_back(pair_of_rays.second);
  }
  return WithoutLandscape(rays_a, rays_b);
}

// The matches that agree with a geometry become the pair's.
void SetInliers(const TwoViewGeometry& geometry, std::span<const RayPair> rays,
                std::span<const FeatureMatch> matches, double bound_rad, PanoPair& pair) {
  std::vector<double> parallaxes;
  pair.inliers.clear();
  for (size_t k = 0; k < rays.size(); ++k) {
    if (!Agrees(geometry, rays[k], bound_rad)) continue;
    pair.inliers.push_back(matches[k]);
    parallaxes.push_back(Parallax(geometry, rays[k]));
  }
  pair.parallax_rad = UpperMedian(parallaxes);
}

struct Judged {
  TwoViewGeometry geometry;
  double score = 0;
};

// Whether the walls of both panoramas can be parallel or square.
bool FitsHeading(const TwoViewGeometry& geometry, std::optional<double> difference_rad) {
  if (!difference_rad) return true;
  return std::abs(WrapQuarter(YawOf(geometry.a_from_b) - *difference_rad)) < kHeadingTolerance_rad;
}

Judged BestUpright(std::span<const RayPair> matches, const TwoViewOptions& options,
                   const PairHints& hints) {
  std::vector<UprightVote> votes;
  for (const RayPair& rays : matches) votes.push_back({rays.first, rays.second, rays.weight});
  Judged best;
  const YawRange yaws = hints.yaw_rad ? YawRange{*hints.yaw_rad, kYawReach_rad} : YawRange{};
  for (const TwoViewGeometry& candidate : VoteUpright(votes, yaws)) {
    const TwoViewGeometry refined = Refine(candidate, matches, options, true);
    double score = Score(refined, matches, DegToRad(options.inlier_deg));
    if (!FitsHeading(refined, hints.heading_difference_rad)) score *= kOffHeadingShare;
    if (score > best.score) best = {refined, score};
  }
  // A candidate that started far off may still be on its way and score a trifle more than those
  // that arrived.
  best.geometry = Refine(best.geometry, matches, options, true);
  best.score = Score(best.geometry, matches, DegToRad(options.inlier_deg));
  return best;
}

}  // namespace

double EpipolarError(const TwoViewGeometry& geometry, const Vector3d& ray_a,
                     const Vector3d& ray_b) {
  const Vector3d b = geometry.a_from_b * ray_b;
  const Vector3d normal_a = geometry.direction.cross(ray_a);
  const Vector3d normal_b = geometry.direction.cross(b);
  const double scale = std::sqrt(normal_a.squaredNorm() + normal_b.squaredNorm());
  return normal_a.dot(b) / std::max(scale, 1e-9);
}

PairDepths TriangulateDepths(const TwoViewGeometry& geometry, const Vector3d& ray_a,
                             const Vector3d& ray_b) {
  const Vector3d b = geometry.a_from_b * ray_b;
  const double cosine = ray_a.dot(b);
  const double sine2 = ray_a.cross(b).squaredNorm();
  if (sine2 < 1e-14) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {kInfinity, kInfinity};
  }
  const double along_a = geometry.direction.dot(ray_a), along_b = geometry.direction.dot(b);
  return {(along_a - along_b * cosine) / sine2, (along_a * cosine - along_b) / sine2};
}

PanoPair EstimatePair(std::span<const Vector3d> level_rays_a,
                      std::span<const Vector3d> level_rays_b, std::span<const FeatureMatch> matches,
                      const TwoViewOptions& options, const PairHints& hints) {
  // 360 or, of each of the four that a heading allows, 11 yaws, with 180 directions.
  constexpr double kLog10AnyYaw = 4.8, kLog10FourYaws = 3.9;
  PanoPair pair;
  pair.num_matches = static_cast<int>(matches.size());
  if (pair.num_matches < kMinMatches) return pair;
  const std::vector<RayPair> rays = RaysOf(level_rays_a, level_rays_b, matches, hints);
  const std::vector<size_t> near_idx = NotOfLandscape(rays);
  std::vector<RayPair> near;
  for (const size_t i : near_idx) near.push_back(rays[i]);
  const double bound_rad = DegToRad(options.inlier_deg);
  const Judged best = BestUpright(near, options, hints);
  pair.a_from_b = best.geometry.a_from_b;
  pair.direction = best.geometry.direction;
  pair.log10_chance = ChanceOfScore(best.geometry, best.score, near, bound_rad,
                                    hints.yaw_rad ? kLog10FourYaws : kLog10AnyYaw);
  std::vector<FeatureMatch> near_matches;
  for (const size_t i : near_idx) near_matches.push_back(matches[i]);
  SetInliers(best.geometry, near, near_matches, bound_rad, pair);
  const auto [rotation, num_turned] = BestRotation(rays);
  const double num_inliers = static_cast<double>(pair.inliers.size());
  if (num_turned >= options.min_inliers && num_turned >= kSamePlaceShare * num_inliers &&
      num_turned >= kTurnedShare * static_cast<double>(rays.size()) &&
      NumSectors(rotation, rays) >= kSamePlaceSectors) {
    pair.verdict = PairVerdict::kSamePlace;
    pair.a_from_b = rotation;
    pair.inliers.clear();
    for (size_t i = 0; i < rays.size(); ++i) {
      if (IsTurned(rotation, rays[i])) pair.inliers.push_back(matches[i]);
    }
  } else if (num_inliers < options.min_inliers) {
    pair.verdict = PairVerdict::kFewMatches;
  } else {
    // What stands far away, as behind windows, agrees with nearly any direction.
    const bool is_far = pair.parallax_rad < kFarParallax_rad;
    const double bound = is_far ? kFarLog10Chance : options.max_log10_chance;
    pair.verdict = pair.log10_chance <= bound ? PairVerdict::kAccepted : PairVerdict::kChance;
  }
  return pair;
}

PanoPair JudgePlace(std::span<const Vector3d> level_rays_a, std::span<const Vector3d> level_rays_b,
                    std::span<const FeatureMatch> matches, std::span<const FeatureMatch> spots,
                    const TwoViewGeometry& geometry, double digits, const TwoViewOptions& options,
                    const PairHints& hints) {
  const double bound_rad = DegToRad(options.inlier_deg);
  const std::vector<RayPair> rays = RaysOf(level_rays_a, level_rays_b, matches, hints);
  std::vector<RayPair> near;
  std::vector<FeatureMatch> all_matches;
  for (const size_t i : NotOfLandscape(rays)) {
    near.push_back(rays[i]);
    all_matches.push_back(matches[i]);
  }
  const std::vector<RayPair> on_floor = RaysOf(level_rays_a, level_rays_b, spots, hints);
  std::vector<RayPair> all = near;
  all.insert(all.end(), on_floor.begin(), on_floor.end());
  all_matches.insert(all_matches.end(), spots.begin(), spots.end());
  const TwoViewGeometry refined = Refine(geometry, all, options, true);
  PanoPair pair;
  pair.num_matches = static_cast<int>(matches.size());
  pair.a_from_b = refined.a_from_b;
  pair.direction = refined.direction;
  SetInliers(refined, all, all_matches, bound_rad, pair);
  pair.log10_chance = -digits;
  if (!near.empty()) {
    pair.log10_chance +=
        ChanceOfScore(refined, Score(refined, near, bound_rad), near, bound_rad, 0);
  }
  if (static_cast<double>(pair.inliers.size()) >= options.min_inliers) {
    pair.verdict = pair.log10_chance <= options.max_log10_chance ? PairVerdict::kAccepted
                                                                 : PairVerdict::kChance;
  }
  return pair;
}

}  // namespace enfilade
