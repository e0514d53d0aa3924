// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "enfilade/evidence/types.h"
#include "enfilade/floorplan/solve.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/floorplan/wall_witness.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// How well the offset of a wall is known, and from what (docs/algorithms/uncertainty.md).
struct WallSigma {
  /// What the probability that the line is another surface rests on.
  struct Grounds {
    double length_m = 0;
    double seen_share = 0;   ///< of the length: wall evidence at the wall itself
    double collinear_m = 0;  ///< length of other walls of the storey on the same line
    bool has_twin = false;   ///< a room behind ends at a wall's thickness from here
    int num_agreeing = 0;    ///< panoramas of which most columns agree with the wall
  };
  Grounds grounds;
  double distance_m = 0;         ///< of the panoramas that measured it; 0 when there are none
  double measured_m = 0;         ///< standard deviation if the line is the wall's
  double wrong_probability = 0;  ///< that the line is another surface's: furniture, a niche
  double sigma_m = 0;            ///< of both together
};

/// The part of a measured variance that all walls of a room share, outwards: camera height, tilt
/// and the choice among a baseboard's lines make a room larger or smaller on all sides.
inline constexpr double kSharedVariance = 0.2;

/// Standard deviation of an offset that is off by N(0, measured²), or, with the given probability,
/// by another surface's distance (exponential). The distribution has heavy tails, so that is not
/// its second moment but the σ for which σ and 2σ hold as much of it as of a normal distribution,
/// σ counting twice.
[[nodiscard]] double SigmaOfMixture(double measured_m, double wrong_probability);

/// One entry a wall of the storey. `witnesses` are those of FindWallWitnesses.
[[nodiscard]] std::vector<WallSigma> FindWallSigmas(
    const EvidenceGrids& evidence, const Storey& storey,
    std::span<const std::vector<WallWitness>> witnesses, const FloorplanOptions& options);

/// Sets Wall::length_sigma_m and Room::area_sigma_m2 from what is known of the walls' offsets: one
/// entry of `sigmas` a wall, of which sigma_m and measured_m count.
void AssignSumSigmas(const std::vector<WallSigma>& sigmas, Storey& storey);

/// Sets what the plan says about its uncertainty: Wall::sigma_m, Wall::length_sigma_m and
/// Room::area_sigma_m2. To be called once openings are found, since panoramas look through them.
///
/// `evidence` has one entry a storey. Cost: that of FindWallWitnesses.
void AssignSigmas(const Scene& scene, const Structure& structure,
                  const std::vector<EvidenceGrids>& evidence, const FloorplanOptions& options,
                  Floorplan& plan);

}  // namespace enfilade
