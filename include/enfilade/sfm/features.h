// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "enfilade/base/options.h"
#include "enfilade/image/image.h"
#include "enfilade/scene/camera.h"
#include "enfilade/sfm/types.h"

namespace enfilade {

/// Whose SIFT finds the features (ChooseFeatureSource decides kAuto).
enum class FeatureSource { kAuto, kColmap, kOpenCv };
[[nodiscard]] std::span<const std::string_view> EnumNames(FeatureSource);

struct FeatureOptions {
  FeatureSource source = FeatureSource::kOpenCv;
  int max_features = 10000;
  double min_contrast = 0.004;
  std::string colmap_program;
  bool keep_colmap_views = false;

  void Visit(OptionVisitor& v) {
    v("source", source, "Program that finds the features; auto: COLMAP where it is installed.");
    v("max_features", max_features,
      "Features kept of a panorama: the strongest, with COLMAP the largest.", {100.0, 100000.0});
    v("min_contrast", min_contrast,
      "Least contrast of a feature (0 … 1): lower finds more on plain walls.", {0.001, 0.2});
    v("colmap_program", colmap_program, "COLMAP's program; empty: `colmap` on the PATH.");
    v("keep_colmap_views", keep_colmap_views,
      "Leave the views that COLMAP was given beside its database.");
  }
};

/// SIFT features (Lowe 2004) of a panorama, found with OpenCV in six virtual views along the walls
/// of its room (MakeWallViews), upright, described as RootSIFT (Arandjelović and Zisserman, CVPR
/// 2012): square roots of the components of the L1-normalised descriptor, times 256, cut at 127.
/// The views overlap, so what lies between two walls may be held twice.
///
/// `pano_from_walls` turns into the camera frame a frame with z up and the walls along its axes.
/// `panorama` is rows × 2·rows × 3 or × 1 of the size that `camera` (equirectangular) tells;
/// `trusted` (rows × 2·rows, 0 = ignore) holds out the camera's stand and what the user masked.
/// Features are ordered by size, then by direction: the same bytes for any number of threads. Uses
/// the calling thread.
[[nodiscard]] PanoFeatures ExtractFeatures(const ImageU8& panorama, const ImageU8& trusted,
                                           const Camera& camera,
                                           const Eigen::Matrix3d& pano_from_walls,
                                           const FeatureOptions& options);

}  // namespace enfilade
