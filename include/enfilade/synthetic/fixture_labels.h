// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "enfilade/image/codec.h"
#include "enfilade/image/image.h"
#include "enfilade/synthetic/home.h"

namespace enfilade {

/// How far from perfect the labels of a panorama's pixels are.
struct LabelNoise {
  double boundary_sigma_deg = 0.6;  ///< by which boundaries are moved along their column
  double correlation_deg = 8;       ///< of azimuth within which boundaries move together
  double blob_deg = 5;              ///< width of the blobs that are confused as a whole
  double blob_share = 0.04;         ///< blobs whose floor, wall or ceiling is taken for another
  double furniture_as_wall_share = 0.2;  ///< blobs whose furniture is taken for wall
  uint64_t seed = 0;
};

/// The labels (SurfaceLabel) that a stage would find in the panorama of home.cameras[camera_idx],
/// size.height × size.width, by casting a ray through each pixel's centre. Without noise they are
/// the renderer's, but for the camera's stand, which is not in the way here.
///
/// Boundaries below the horizon and above it are moved by two Gaussian processes round the
/// panorama: standard deviation boundary_sigma_deg, correlation exp(−a² / (2 correlation_deg²)) at
/// the azimuth a apart; a boundary is never moved across the horizon. Blobs are the cells of a
/// jittered grid (as superpixels are), blob_deg high and at the horizon as wide. In a confused one
/// floor and ceiling become wall, and wall becomes floor below and ceiling above the horizon.
///
/// The home, the camera and the noise determine every byte. Cost: one ray a pixel.
[[nodiscard]] ImageU8 FixtureLabels(const Home& home, int camera_idx, ImageSize size,
                                    const LabelNoise& noise = {});

}  // namespace enfilade
