// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/evidence/types.h"

namespace enfilade {

/// How wall samples become grids.
struct AccumulateOptions {
  EvidenceMode mode = EvidenceMode::kLogOdds;  ///< chosen by who needs the grids, not by users
  double cell_m = 0.025;
  double margin_m = 0.5;
  double max_range_m = 15;
  double max_megacells = 25;
  double blocked_depth_m = 0.15;
  double outlier_probability = 0.15;
  double half_trust_range_m = 6;
  double max_view_log_odds = 2.5;
  double mean_free_path_m = 3;
  double position_sigma_m = 0.02;
  double angle_sigma_deg = 0.2;
  double camera_height_m = 1.4;
  double same_place_m = 0.5;
  double near_m = 2.25;
  double min_angle_deg = 25;
  double min_support_probability = 0.8;
  int consistency_rounds = 1;
  double point_weight = 0.5;

  void Visit(OptionVisitor& v);
};

enum class EvidenceOutcome { kDone, kNoSamples };

struct EvidenceReport {
  EvidenceOutcome outcome = EvidenceOutcome::kDone;
  std::string reason;  ///< one line when the outcome is not kDone
  int num_views = 0;
  int64_t num_samples = 0;      ///< columns that saw something
  int64_t num_wall_points = 0;  ///< scene points taken as wall
  int64_t num_ray_points = 0;   ///< scene points whose rays were taken as free
  EvidenceGrids grids;          ///< without core
};

/// Adds the wall samples and points of one storey up into grids of wall and free-space evidence.
///
/// Every cell asks every view once: the distribution of the wall's distance in the cell's direction
/// (interpolated between the two nearest columns so that straight walls stay straight) says how
/// likely the wall lies beyond the cell, in it, or just before it. Log-odds of the views are
/// summed. So columns of one view never count twice in a cell, and there are no holes far from the
/// camera.
///
/// Guarantees: |contribution of one view| ≤ max_view_log_odds; views at one place (within
/// same_place_m) share one vote, so duplicates change nothing; the result does not depend on the
/// order of samples or views nor on the number of threads; the grid is aligned to whole multiples
/// of cell_m, so translating the input by such a multiple translates the grid.
///
/// A report without samples has the outcome kNoSamples and empty grids. Throws InvalidInputError
/// when the extent needs more than max_megacells or the context's memory cap. Requires finite
/// samples whose probabilities have one entry a bin. Cost O(cells × views).
///
/// Inverse sensor model after Elfes (1989) and Thrun (2003); counts after Cabral & Furukawa (2014).
[[nodiscard]] EvidenceReport AccumulateEvidence(const WallSampleSet& samples,
                                                const EvidencePoints& points,
                                                const AccumulateOptions& options,
                                                RunContext& context);

}  // namespace enfilade
