// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/image/image.h"
#include "enfilade/image/superpixels.h"
#include "enfilade/scene/surface_label.h"
#include "enfilade/structure/column_scores.h"

namespace enfilade {

struct ClassifyOptions {
  int width = 1024;
  SuperpixelOptions superpixels;
  int min_seed_points = 5;
  double seed_share = 0.5;
  double max_distance_m = 15;
  double beyond_power = 3;
  double home_share = 0.5;
  double max_cost = 4;
  double smoothness = 1;
  double line_discount = 0.8;
  double order_cost = 4;

  void Visit(OptionVisitor& v) {
    v("width", width, "Width to which larger panoramas are reduced before, pixels.", {64, 8192});
    v("superpixels", superpixels, "Superpixels.");
    v("min_seed_points", min_seed_points, "Points of one label that make a superpixel a seed.",
      {1, 1000});
    v("seed_share", seed_share,
      "Share of a superpixel before the nearest wall that makes it a seed of floor or ceiling.",
      {0, 1});
    v("max_distance_m", max_distance_m, "Farthest wall: what is nearer to the horizon is wall.",
      {2, 200});
    v("beyond_power", beyond_power,
      "How near walls are to where they are expected: one stands beyond twice the distance at "
      "which free space ends with probability 2 to minus this.",
      {0.1, 20});
    v("home_share", home_share,
      "Share of the whole home's seeds, beside the panorama's own, in what colours mean.", {0, 1});
    v("max_cost", max_cost, "Most that colour and elevation count against a label, nats.",
      {0.1, 100});
    v("smoothness", smoothness,
      "Cost of a border between labels as long as a superpixel, nats; less where colours differ.",
      {0, 100});
    v("line_discount", line_discount, "Share of it that a clear line along the border takes off.",
      {0, 1});
    v("order_cost", order_cost,
      "Cost of a border as long as a superpixel with the lower label above, nats.", {0, 1000});
  }
};

/// A point that a panorama sees.
struct SeenPoint {
  Eigen::Vector3f direction{1, 0, 0};  ///< from the camera, in the panorama's frame
  SurfaceLabel label = SurfaceLabel::kOther;
};

/// What is known of a panorama before its pixels are classified. Heights and distances in metres.
struct ClassifyView {
  Superpixels superpixels;  ///< of the level panorama
  ImageU8 is_seen;          ///< of the level panorama
  ImageU8 lines;  ///< rows × any number of columns: how much a pixel looks like lying on a line
                  ///< between floor or ceiling and wall, 0–255; may be empty
  double floor_m = 0;    ///< of the camera above the floor
  double ceiling_m = 0;  ///< of the ceiling above the camera
  /// By column, any number of them: core free space reaches so far, no wall is nearer. Zero: not
  /// known.
  std::vector<double> clear_m;
  /// By column, any number of them: where the wall was found otherwise. Empty: not known, walls are
  /// expected where free space ends.
  std::vector<double> wall_m;
  std::vector<SeenPoint> points;
};

/// A SurfaceLabel for every pixel of a level panorama, stage by stage: kOther is not known yet.
struct LabelMaps {
  ImageU8 after_points;      ///< seeds of the points that the panorama sees
  ImageU8 after_free_space;  ///< and of core free space
  ImageU8 final_labels;      ///< propagated to all superpixels
};

struct Classification {
  LabelMaps maps;
  /// By superpixel: what floor, wall and ceiling cost it by colour, elevation and seeds, nats; no
  /// more than max_cost.
  std::vector<std::array<float, 3>> costs;
  double energy = 0;       ///< of the final labels
  double seed_energy = 0;  ///< of the labels that colour and elevation alone would give
  int num_superpixels = 0;
  int num_point_seeds = 0;
  int num_free_seeds = 0;
  int num_contradictions = 0;  ///< superpixels with wall points before the end of free space
  /// Solid angle of the seeds of floor, wall and ceiling.
  std::array<double, 3> seed_sr{};
};

/// Labels every pixel of the panoramas of a home floor, wall or ceiling, structurally: clutter in
/// front of a wall is wall, what stands on the floor before it is floor. The three stages of Cabral
/// and Furukawa (CVPR 2014, section 6), each on superpixels:
///
/// A. A superpixel with at least min_seed_points points of one label, and most of that, has it.
/// B. Core free space bounds the distance of the wall in every column: what lies below the floor's
///    line at that distance is floor, above the ceiling's ceiling. A superpixel with seed_share of
///    its pixels so bound has the label, whatever A said.
/// C. Propagation, which the paper does not describe: the labels of least energy, exactly
///    (FindOrderedLabels). A label costs −log of its probability by colour (a histogram of CIELAB
///    for each label, from the panorama's seeds and the home's) and elevation (walls stand where
///    free space ends or behind, see beyond_power, or about wall_m). A border between
///    labels costs by its length, less where colours differ and lines run; and that the lower label
///    is above the upper one costs extra.
///
/// What lies nearer to the horizon than a wall at max_distance_m serves as seed of wall. Pixels
/// that are not seen get labels but teach nothing. Results stand in the order of `views`.
[[nodiscard]] std::vector<Classification> ClassifyPanoramas(const std::vector<ClassifyView>& views,
                                                            const ClassifyOptions& options,
                                                            RunContext& context);

/// The same maps as the camera saw them: equirectangular, of the same size.
[[nodiscard]] LabelMaps MapsInCamera(const LabelMaps& level, const Eigen::Matrix3d& home_from_cam);

/// What the labels say of the wall's distance: minus the costs of the labels that a wall at each
/// distance gives the pixels of a column, summed over their elevation (nats times radians), less
/// the most of the column, and no less than −max_loss: labels may be wrong. Alike for all families.
[[nodiscard]] ColumnScores ScoreLabels(const ClassifyView& view, const Classification& labels,
                                       int num_columns, const DistanceBins& bins, double max_loss);

}  // namespace enfilade
