// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evidence/accumulate.h"

#include <algorithm>
#include <cmath>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"
#include "grid_extent.h"
#include "point_evidence.h"
#include "view_evidence.h"

namespace enfilade {
namespace {

// The rays of one view to neighbouring points are no independent evidence: counts enter by
// logarithm.
void AddPoints(const PointCounts& counts, const AccumulateOptions& options, EvidenceGrids& grids) {
  const auto limit = static_cast<float>(options.max_view_log_odds);
  const auto weight = static_cast<float>(options.point_weight);
  for (size_t i = 0; i < grids.wall.data().size(); ++i) {
    const float hits = std::log1p(counts.wall.data()[i]), rays = std::log1p(counts.rays.data()[i]);
    grids.wall.data()[i] += std::clamp(weight * (2 * hits - rays), -limit, limit);
    grids.free.data()[i] += std::clamp(weight * (rays - 2 * hits), -limit, limit);
  }
}

// Neighbouring columns see one surface where their distances differ by less than this part.
constexpr double kMaxJump = 0.1;

// What a column says, between its neighbours: a direction and the wall's distance in it.
struct Reading {
  Eigen::Vector2d direction;
  double wall_m;
};

// Part `share` of the way from a column to its neighbour. On one straight wall 1/distance is linear
// in the azimuth.
Reading Between(const WallSample& sample, const WallSample& neighbor, double share) {
  Reading reading{(sample.direction + share * (neighbor.direction - sample.direction)).normalized(),
                  sample.wall_m};
  const double jump = std::abs(neighbor.wall_m - sample.wall_m);
  if (jump < kMaxJump * std::min(neighbor.wall_m, sample.wall_m)) {
    reading.wall_m = 1 / ((1 - share) / sample.wall_m + share / neighbor.wall_m);
  }
  return reading;
}

// The readings of column i, so close together that they leave no cell between them at its wall.
std::vector<Reading> ReadingsOf(const std::vector<WallSample>& samples, size_t i, double cell_m) {
  const WallSample& sample = samples[i];
  const auto neighbor = [&](bool is_next) -> const WallSample* {
    if (is_next ? i + 1 >= samples.size() : i == 0) return nullptr;
    const WallSample& other = samples[is_next ? i + 1 : i - 1];
    const bool is_beside = other.view_idx == sample.view_idx && !other.wall_probability.empty() &&
                           (other.direction - sample.direction).norm() < 1.5 * sample.spread_rad;
    return is_beside ? &other : nullptr;
  };
  std::vector<Reading> readings = {{sample.direction, sample.wall_m}};
  const int num_beside =
      static_cast<int>(std::ceil(0.5 * (sample.wall_m * sample.spread_rad / cell_m - 1)));
  for (const bool is_next : {false, true}) {
    const WallSample* other = neighbor(is_next);
    for (int k = 1; other != nullptr && k <= num_beside; ++k) {
      readings.push_back(Between(sample, *other, static_cast<double>(k) / (2 * num_beside + 1)));
    }
  }
  return readings;
}

// The paper's maps: a column is a wall point at its most likely distance and a ray, several where
// columns are farther apart than a cell.
void ReplaceByCounts(const WallSampleSet& samples, const PointCounts& counts,
                     const AccumulateOptions& options, double ray_margin_m, EvidenceGrids& grids) {
  grids.wall = counts.wall;
  grids.free = counts.rays;
  for (size_t i = 0; i < samples.samples.size(); ++i) {
    const WallSample& sample = samples.samples[i];
    if (sample.wall_probability.empty()) continue;
    for (const Reading& reading : ReadingsOf(samples.samples, i, options.cell_m)) {
      const double reach = std::min(reading.wall_m, options.max_range_m + ray_margin_m);
      CountRay(grids.frame, sample.origin, sample.origin + reach * reading.direction, ray_margin_m,
               grids.free);
      if (reading.wall_m > options.max_range_m) continue;
      const Eigen::Vector2d point = sample.origin + reading.wall_m * reading.direction;
      const int row = grids.frame.Row(point.y()), col = grids.frame.Col(point.x());
      if (grids.frame.IsInside(row, col)) grids.wall(row, col) += 1;
    }
  }
}

EvidenceGrids EmptyGrids(const GridFrame& frame, EvidenceMode mode) {
  EvidenceGrids grids;
  grids.frame = frame;
  grids.mode = mode;
  grids.wall = ImageF(frame.rows, frame.cols);
  grids.free = ImageF(frame.rows, frame.cols);
  grids.support = ImageU8(frame.rows, frame.cols);
  grids.core = CoreImage(frame.rows, frame.cols);
  return grids;
}

}  // namespace

void AccumulateOptions::Visit(OptionVisitor& v) {
  v("cell_m", cell_m, "Side of a grid cell.", {0.005, 0.5});
  v("margin_m", margin_m, "Border round everything seen.", {0.1, 5});
  v("max_range_m", max_range_m, "Columns say nothing beyond this distance.", {1, 100});
  v("max_megacells", max_megacells, "Refuse grids of more million cells.", {0.01, 1000});
  v("blocked_depth_m", blocked_depth_m, "How far behind a wall face the cells count as blocked.",
    {0, 1});
  v("outlier_probability", outlier_probability,
    "Probability that a column near the camera says nothing true.", {0.001, 0.9});
  v("half_trust_range_m", half_trust_range_m, "Distance at which a column is trusted half as much.",
    {0.5, 100});
  v("max_view_log_odds", max_view_log_odds, "Most that one panorama can say about a cell.",
    {0.1, 20});
  v("mean_free_path_m", mean_free_path_m, "Prior: mean distance to a wall.", {0.1, 100});
  v("position_sigma_m", position_sigma_m, "Standard deviation of camera positions.", {0, 1});
  v("angle_sigma_deg", angle_sigma_deg, "Standard deviation of a floor line's elevation.", {0, 10});
  v("camera_height_m", camera_height_m, "Typical height of camera over the line it measures by.",
    {0.1, 10});
  v("same_place_m", same_place_m, "Panoramas nearer than this share a vote.", {0, 10});
  v("near_m", near_m,
    "Floor nearer than this to a camera needs no second witness, farther floor seen walls.",
    {0, 10});
  v("min_angle_deg", min_angle_deg, "Angle from which two views look from different directions.",
    {1, 90});
  v("min_support_probability", min_support_probability,
    "Probability of being free that makes a view a witness.", {0.5, 1});
  v("consistency_rounds", consistency_rounds,
    "How often columns lose trust where other views say they ran through a wall.", {0, 10});
  v("point_weight", point_weight, "Weight of scene points beside columns.", {0, 10});
}

EvidenceReport AccumulateEvidence(const WallSampleSet& samples, const EvidencePoints& points,
                                  const AccumulateOptions& options, RunContext& context) {
  EvidenceReport report;
  for (const WallSample& sample : samples.samples)
    report.num_samples += !sample.wall_probability.empty();
  if (report.num_samples == 0) {
    report.outcome = EvidenceOutcome::kNoSamples;
    report.reason = "no column of any panorama saw a wall";
    return report;
  }
  const RangeBins bins(samples.bin_m, {options.position_sigma_m, DegToRad(options.angle_sigma_deg),
                                       options.camera_height_m});
  ViewEvidence evidence{options, MakePolarViews(samples, bins, context), {}, 0};
  evidence.weights = WeightsByPlace(evidence.views, options.same_place_m);
  evidence.far_m = std::min(static_cast<float>(options.max_range_m), bins.far_m());
  report.num_views = static_cast<int>(evidence.views.size());
  std::vector<EvidenceCamera> cameras;
  for (const PolarView& view : evidence.views) cameras.push_back({view.view_idx(), view.origin()});

  report.grids = EmptyGrids(FrameOfEvidence(samples, cameras, options, context), options.mode);
  report.grids.cameras = std::move(cameras);
  AccumulateViews(evidence, report.grids, context);
  for (int round = 0; round < options.consistency_rounds; ++round) {
    DistrustContradictedColumns(report.grids, evidence, context);
    AccumulateViews(evidence, report.grids, context);
  }

  const double ray_margin_m = std::max(2 * options.cell_m, 0.05);
  const PointCounts counts =
      CountPoints(report.grids.frame, points, ray_margin_m, options.max_range_m);
  report.num_wall_points = counts.num_wall_points;
  report.num_ray_points = counts.num_ray_points;
  if (options.mode == EvidenceMode::kCounts) {
    ReplaceByCounts(samples, counts, options, ray_margin_m, report.grids);
  } else if (!points.points.empty()) {
    AddPoints(counts, options, report.grids);
  }
  return report;
}

}  // namespace enfilade
