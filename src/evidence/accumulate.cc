// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evidence/accumulate.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"
#include "grid_extent.h"
#include "point_evidence.h"
#include "polar_view.h"
#include "sensor_model.h"

namespace enfilade {
namespace {

constexpr int kRowsPerTask = 8;

struct Inputs {
  const AccumulateOptions& options;
  const std::vector<PolarView>& views;
  const std::vector<double>& weights;  // of the views
  float far_m;                         // nothing is said beyond
};

// Free space that a view is sure of, from where.
class SupportCollector {
 public:
  explicit SupportCollector(double min_angle_rad)
      : max_cosine_(static_cast<float>(std::cos(min_angle_rad))) {}
  void AddNear() { bits_ |= kSupportNear; }
  void AddDirection(const Eigen::Vector2f& unit) {
    if ((bits_ & kSupportTwoDirections) != 0) return;
    for (const Eigen::Vector2f& other : directions_) {
      if (unit.dot(other) <= max_cosine_) bits_ |= kSupportTwoDirections;
    }
    directions_.push_back(unit);
  }
  uint8_t TakeBits() {
    directions_.clear();
    return std::exchange(bits_, uint8_t{0});
  }

 private:
  float max_cosine_;
  uint8_t bits_ = 0;
  std::vector<Eigen::Vector2f> directions_;
};

// The view's reading of one cell, added to the cell's sums.
void AddViewToCell(const Inputs& in, const SensorModel& model, size_t view_idx,
                   const Eigen::Vector2f& offset, float& wall, float& free,
                   SupportCollector& support) {
  const AccumulateOptions& options = in.options;
  const float r = offset.norm();
  const auto cell = static_cast<float>(options.cell_m);
  if (r > in.far_m) return;
  if (r < 0.5f * cell) {  // the camera's own cell has no direction
    free += model.Quantised(options.max_view_log_odds * in.weights[view_idx]);
    wall -= model.Quantised(options.max_view_log_odds * in.weights[view_idx]);
    support.AddNear();
    return;
  }
  const Eigen::Vector2f unit = offset / r;
  const float half_width = 0.5f * cell * (std::abs(unit.x()) + std::abs(unit.y()));
  const auto reading =
      in.views[view_idx].Read(offset, r, half_width, static_cast<float>(options.blocked_depth_m));
  if (!reading) return;
  const CellLogOdds log_odds = model.Evaluate(*reading, r, half_width, in.weights[view_idx]);
  free += log_odds.free;
  wall += log_odds.wall;
  if (1 - reading->cdf_far < options.min_support_probability) return;
  if (r <= std::min(static_cast<float>(options.near_m), reading->obstacle_m)) support.AddNear();
  support.AddDirection(unit);
}

// One row at a time: every cell asks every view.
void FillRow(const Inputs& in, const SensorModel& model, int row, EvidenceGrids& grids) {
  SupportCollector support(DegToRad(in.options.min_angle_deg));
  for (int col = 0; col < grids.frame.cols; ++col) {
    const Eigen::Vector2d center = grids.frame.Center(row, col);
    float wall = 0, free = 0;
    for (size_t v = 0; v < in.views.size(); ++v) {
      const Eigen::Vector2f offset = (center - in.views[v].origin()).cast<float>();
      AddViewToCell(in, model, v, offset, wall, free, support);
    }
    grids.wall(row, col) = wall;
    grids.free(row, col) = free;
    grids.support(row, col) = support.TakeBits();
  }
}

void AccumulateViews(const Inputs& in, EvidenceGrids& grids, RunContext& context) {
  const SensorModel model(in.options);
  const int num_tasks = (grids.frame.rows + kRowsPerTask - 1) / kRowsPerTask;
  ParallelFor(context, "evidence", num_tasks, [&](int64_t task) {
    const int begin = static_cast<int>(task) * kRowsPerTask;
    const int end = std::min(begin + kRowsPerTask, grids.frame.rows);
    for (int row = begin; row < end; ++row) FillRow(in, model, row, grids);
  });
}

// Views closer than same_place_m err together (same pose error, same furniture in the way), so they
// share a vote. Quantised terms make the sums exact in any order.
std::vector<double> WeightsByPlace(const std::vector<PolarView>& views, double same_place_m) {
  std::vector<double> weights;
  for (const PolarView& a : views) {
    double crowd = 0;
    for (const PolarView& b : views) {
      const double distance = (a.origin() - b.origin()).norm();
      const double closeness = &a == &b           ? 1
                               : same_place_m > 0 ? std::max(0.0, 1 - distance / same_place_m)
                                                  : 0;
      crowd += std::round(closeness * 4096) / 4096;
    }
    weights.push_back(1 / crowd);
  }
  return weights;
}

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

// The paper's maps: every column is one wall point at its most likely distance and one ray.
void ReplaceByCounts(const WallSampleSet& samples, const PointCounts& counts,
                     const AccumulateOptions& options, double ray_margin_m, EvidenceGrids& grids) {
  grids.wall = counts.wall;
  grids.free = counts.rays;
  for (const WallSample& sample : samples.samples) {
    if (sample.wall_probability.empty()) continue;
    const double reach = std::min(sample.wall_m, options.max_range_m + ray_margin_m);
    CountRay(grids.frame, sample.origin, sample.origin + reach * sample.direction, ray_margin_m,
             grids.free);
    if (sample.wall_m > options.max_range_m) continue;
    const Eigen::Vector2d point = sample.origin + sample.wall_m * sample.direction;
    const int row = grids.frame.Row(point.y()), col = grids.frame.Col(point.x());
    if (grids.frame.IsInside(row, col)) grids.wall(row, col) += 1;
  }
}

EvidenceGrids EmptyGrids(const GridFrame& frame, EvidenceMode mode) {
  EvidenceGrids grids;
  grids.frame = frame;
  grids.mode = mode;
  grids.wall = ImageF(frame.rows, frame.cols);
  grids.free = ImageF(frame.rows, frame.cols);
  grids.support = ImageU8(frame.rows, frame.cols);
  grids.core = ImageU8(frame.rows, frame.cols);
  return grids;
}

}  // namespace

void AccumulateOptions::Visit(OptionVisitor& v) {
  v("mode", mode, "What the grids hold: log-odds, or raw counts as Cabral & Furukawa (2014).");
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
  v("near_m", near_m, "Floor nearer than this to a camera needs no second witness.", {0, 10});
  v("min_angle_deg", min_angle_deg, "Angle from which two views look from different directions.",
    {1, 90});
  v("min_support_probability", min_support_probability,
    "Probability of being free that makes a view a witness.", {0.5, 1});
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
  const DistanceBins bins(
      samples.bin_m,
      {options.position_sigma_m, DegToRad(options.angle_sigma_deg), options.camera_height_m});
  const std::vector<PolarView> views = MakePolarViews(samples, bins, context);
  report.num_views = static_cast<int>(views.size());
  std::vector<EvidenceCamera> cameras;
  for (const PolarView& view : views) cameras.push_back({view.view_idx(), view.origin()});

  report.grids = EmptyGrids(FrameOfEvidence(samples, cameras, options, context), options.mode);
  report.grids.cameras = std::move(cameras);
  const std::vector<double> weights = WeightsByPlace(views, options.same_place_m);
  const float far_m = std::min(static_cast<float>(options.max_range_m), bins.far_m());
  AccumulateViews({options, views, weights, far_m}, report.grids, context);

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
