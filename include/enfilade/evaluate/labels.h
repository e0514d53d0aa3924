// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "enfilade/base/run_context.h"
#include "enfilade/exchange/ground_truth.h"
#include "enfilade/image/image.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/classify.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// Floor, wall and ceiling of one panorama against the truth.
struct PanoramaLabels {
  int view_idx = 0;
  std::optional<double> accuracy;  ///< share of the judged pixels
  std::optional<double> iou_mean;  ///< over the classes that the truth shows
  /// The accuracy of the superpixels' labels after each stage of their classification; pixels that
  /// are not known yet are wrong.
  std::optional<double> points_accuracy, free_space_accuracy, superpixel_accuracy;
};

/// The same over the panoramas: medians of their figures.
struct LabelFigures {
  std::vector<PanoramaLabels> panoramas;  ///< in the order of the profiles
  std::optional<double> accuracy, iou_mean;
  std::optional<double> points_accuracy, free_space_accuracy, superpixel_accuracy;
};

/// The label maps of a view as its camera saw them, none where it was not classified. Called from
/// several threads.
using LabelSource = std::function<std::optional<LabelMaps>(int view_idx)>;

/// The SurfaceLabel of every pixel of an equirectangular panorama of that size that the profile
/// implies: the ray of the pixel's centre meets the floor or the ceiling before the wall, or the
/// wall of its column. kOther where the column has no positive finite distance.
[[nodiscard]] ImageU8 LabelsOfProfile(const WallProfile& profile, const Rigid3& home_from_cam,
                                      int rows, int cols);

/// Judges the labels that the profiles of panoramas imply, and those of `maps` where there are
/// some, against the truth's: labels of its own at their resolution, less pixels of kOther
/// (furniture); else, for panoramas taken inside their layout in a room whose ceiling's height is
/// known, the layout projected into the picture (1024 × 512). Truth files are read one per thread
/// at a time. `truth_idx` as in EvaluateColumns. Throws what ReadTruthLabels throws.
[[nodiscard]] LabelFigures EvaluateLabels(const Scene& scene, const Structure& structure,
                                          const GroundTruth& truth, std::span<const int> truth_idx,
                                          const LabelSource& maps, RunContext& context);

}  // namespace enfilade
