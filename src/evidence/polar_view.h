// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/evidence/types.h"

namespace enfilade {

/// How the error of a wall's distance grows with the distance r:
/// σ(r)² = position² + (angle·(r² + h²)/h)², from r = h / tan(elevation of the floor line).
struct DistanceError {
  double position_sigma_m = 0;
  double angle_sigma_rad = 0;
  double camera_height_m = 1;

  [[nodiscard]] double Sigma(double r_m) const;
};

/// The distance bins of a sample set with what every column shares: edges, a table that finds the
/// bin of a distance, and the blur by DistanceError as a band matrix.
class RangeBins {
 public:
  RangeBins(const std::vector<double>& bin_m, const DistanceError& error);

  [[nodiscard]] int size() const { return static_cast<int>(edge_m_.size()) - 1; }
  [[nodiscard]] float edge_m(int i) const { return edge_m_[i]; }
  [[nodiscard]] float far_m() const { return edge_m_.back(); }

  /// P(wall nearer than edge i) for i = 0 … size(), of the blurred and normalised distribution.
  void BlurredCdf(const std::vector<float>& probability, float* cdf) const;
  /// Linear interpolation of a table of values at the edges, constant beyond the first and last.
  [[nodiscard]] float Evaluate(const float* at_edges, float r_m) const;

 private:
  [[nodiscard]] int BinAt(float r_m) const;

  std::vector<float> edge_m_;
  std::vector<int> bin_of_step_;  // bin at the distance edge_m_[0] + step · step_m_
  float steps_per_m_ = 1;
  struct Spread {
    int first = 0;            // first bin that gets mass
    std::vector<float> mass;  // sums to one
  };
  std::vector<Spread> spread_;
};

/// What a view says along one direction, for one cell at distance r.
struct PolarReading {
  float cdf_near = 0;     ///< P(wall nearer than r − half_width)
  float cdf = 0;          ///< P(wall nearer than r)
  float cdf_far = 0;      ///< P(wall nearer than r + half_width)
  float cdf_blocked = 0;  ///< P(wall nearer than r − blocked_depth)
  float obstacle_m = 0;   ///< first obstacle in this direction
  float trust = 1;        ///< 0–1: how far the column is believed at r
};

/// All columns of one view, for lookups by direction and distance.
class PolarView {
 public:
  /// `columns` are samples of one view that saw something; not empty.
  PolarView(const RangeBins& bins, std::vector<const WallSample*> columns);

  [[nodiscard]] const Eigen::Vector2d& origin() const { return origin_; }
  [[nodiscard]] int view_idx() const { return view_idx_; }
  [[nodiscard]] const RangeBins& bins() const { return *bins_; }
  [[nodiscard]] int num_columns() const { return static_cast<int>(columns_.size()); }
  [[nodiscard]] Eigen::Vector2d Direction(int column) const;
  /// columns × (bins + 1) values at the edges of the bins, columns by ascending azimuth.
  void set_trust(std::vector<float> trust) { trust_ = std::move(trust); }

  /// None where no column covers the direction of `offset` = cell centre − origin(), or where the
  /// wall surely lies before r − blocked_depth, so that nothing is known.
  ///
  /// Between two columns that see the same surface the distributions are stretched so that 1/r is
  /// linear in azimuth, which is exact on straight walls; else the nearer column answers alone.
  [[nodiscard]] std::optional<PolarReading> Read(const Eigen::Vector2f& offset, float r_m,
                                                 float half_width_m, float blocked_depth_m) const;

 private:
  struct Column {
    float azimuth_rad;
    float half_spread_rad;
    float mode_m;  // most likely distance
    float obstacle_m;
    float confidence;
    float clear_m;  // no mass nearer than this
    float end_m;    // no mass farther than this
  };
  // Up to two columns that answer for a direction.
  struct Neighbours {
    int column[2];
    float weight[2];
    float stretch[2];
  };
  [[nodiscard]] bool FindNeighbours(float azimuth_rad, Neighbours& n) const;
  [[nodiscard]] const float* RowOf(const std::vector<float>& table, int column) const {
    return table.data() + static_cast<size_t>(column) * static_cast<size_t>(bins_->size() + 1);
  }

  const RangeBins* bins_;
  int view_idx_;
  Eigen::Vector2d origin_;
  std::vector<Column> columns_;     // ascending azimuth
  std::vector<float> cdf_;          // columns × (bins + 1)
  std::vector<float> trust_;        // the same shape; empty while all is trusted
  std::vector<int> first_at_step_;  // first column at or after the azimuth −π + step·2π/steps
};

/// The views of a sample set in ascending view_idx; columns without a distribution are left out.
/// Checks (as bugs) that samples are finite, have one entry a bin, and that a view has one origin.
[[nodiscard]] std::vector<PolarView> MakePolarViews(const WallSampleSet& samples,
                                                    const RangeBins& bins, RunContext& context);

}  // namespace enfilade
