// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "enfilade/evidence/grid.h"
#include "enfilade/scene/types.h"

namespace enfilade {

/// What one column of one panorama says about the wall in its direction. `structure` produces
/// these.
struct WallSample {
  int view_idx = 0;
  Eigen::Vector2d origin{0, 0};     ///< camera in the home plan, metres; the same for a whole view
  Eigen::Vector2d direction{1, 0};  ///< unit, horizontal, home frame
  double spread_rad = 0;            ///< angular width of the column
  double wall_m = 0;                ///< most likely distance of the structural wall
  double obstacle_m = 0;            ///< most likely distance of the first obstacle, ≤ wall_m
  double confidence = 1;            ///< 0–1: how far wall_probability is to be believed
  /// P(wall in bin i) over the bins of WallSampleSet; sums to one. Empty when the column saw
  /// nothing.
  std::vector<float> wall_probability;
};

/// Samples that share their distance bins.
struct WallSampleSet {
  std::vector<double> bin_m;  ///< ascending centres of the distance bins
  std::vector<WallSample> samples;
};

/// Reconstructed points as weak further evidence. Everything is in the home frame.
struct EvidencePoints {
  std::vector<ScenePoint> points;
  /// Camera centre of every view that a point names, indexed by view_idx.
  std::vector<Eigen::Vector3d> camera_positions;
  double floor_z = 0;
  double ceiling_z = 0;
};

/// Where a panorama stands in the plan.
struct EvidenceCamera {
  int view_idx = 0;
  Eigen::Vector2d position{0, 0};
};

/// What the values of `wall` and `free` mean.
enum class EvidenceMode {
  kLogOdds,  ///< natural log-odds, 0 = unknown
  kCounts,   ///< number of wall points in the cell, number of rays across it (Cabral & Furukawa
             ///< 2014)
};
[[nodiscard]] std::span<const std::string_view> EnumNames(EvidenceMode);

/// Bits of EvidenceGrids::support: why free space may be believed to be inside the home.
inline constexpr uint8_t kSupportNear = 1;           ///< near a camera, over unbroken floor
inline constexpr uint8_t kSupportTwoDirections = 2;  ///< seen free from two different directions
inline constexpr uint8_t kSupportFar = 4;  ///< as kSupportNear, but farther: a weak reason
inline constexpr uint8_t kStrongSupport = kSupportNear | kSupportTwoDirections;

/// Of each cell 0, or 1 + the index of the core component that it belongs to.
using CoreImage = Image<uint16_t>;

/// The evidence of one storey. All images have frame.rows × frame.cols pixels.
struct EvidenceGrids {
  GridFrame frame;
  EvidenceMode mode = EvidenceMode::kLogOdds;
  ImageF wall;      ///< that a wall face lies in the cell: negative where rays pass through it
  ImageF free;      ///< that the cell is free up to the structural wall: negative just behind walls
  ImageU8 support;  ///< kSupport bits
  CoreImage core;
  int num_cores = 0;
  std::vector<EvidenceCamera> cameras;  ///< ascending view_idx, one a view that has samples
};

}  // namespace enfilade
