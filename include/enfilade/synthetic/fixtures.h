// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "enfilade/evidence/types.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"
#include "enfilade/synthetic/home.h"

namespace enfilade {

/// How far from perfect the wall profiles of a fixture are.
struct ProfileNoise {
  int num_columns = 512;
  double min_m = 0.25, max_m = 16;  ///< first and last distance bin
  int num_bins = 240;               ///< spaced geometrically
  double sigma_relative = 0;        ///< Gaussian error of each column, as a share of its distance
  double outlier_share = 0;         ///< columns whose distance is uniform in [min_m, max_m]
  double unseen_share = 0;          ///< columns that saw nothing
  double spread_relative = 0.015;   ///< width of wall_probability round the reported distance
  bool are_doors_walls = false;     ///< open doors end the look instead of showing the next room
  uint64_t seed = 0;
};

/// The structure that a perfect (or, with noise, an imperfect) stage would find: directions,
/// heights of every storey and one wall profile per camera, by casting rays through the true plan
/// of its storey.
[[nodiscard]] Structure FixtureStructure(const Home& home, const ProfileNoise& noise = {});

/// The same as wall samples, one per camera of the storey and column that saw something.
[[nodiscard]] WallSampleSet FixtureWallSamples(const Home& home, const ProfileNoise& noise = {},
                                               int storey_idx = 0);

/// The views of the home's cameras with their poses and no pictures, in the order of home.cameras.
[[nodiscard]] Scene FixtureScene(const Home& home, int width = 1024, int height = 512);

}  // namespace enfilade
