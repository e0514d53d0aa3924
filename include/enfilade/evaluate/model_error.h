// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "enfilade/base/options.h"
#include "enfilade/base/run_context.h"
#include "enfilade/exchange/ground_truth.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/image/image.h"
#include "enfilade/model/types.h"
#include "enfilade/model/visibility.h"

namespace enfilade {

/// How well the model fits what one panorama sees.
struct PanoramaModelError {
  int view_idx = 0;
  int num_pixels = 0;                       ///< judged ones
  std::optional<double> hit_share;          ///< of them, how many see a face of the model
  std::optional<double> depth_within_5pct;  ///< share with |model − truth| / truth within 0.05
  /// Medians of |model − truth| along the ray and of the angle between the normals; infinite where
  /// they fall on pixels without a face.
  std::optional<double> depth_median_m, normal_median_deg;
};

/// The errors pixel by pixel, equirectangular. NaN where nothing is judged, infinite where the
/// model has no face.
struct ModelErrorMap {
  PanoramaModelError figures;
  ImageF depth_error_m;     ///< model − truth along the ray: positive where the model is too far
  ImageF normal_error_deg;  ///< 0–180
  Image<int> face_idx;      ///< of the face seen, −1 for none
};

struct ModelErrorOptions {
  /// Width of the maps; the truth is sampled at pixels of its own, whose centres are cast.
  int map_width = 512;

  void Visit(OptionVisitor& v) {
    v("map_width", map_width, "Width of the maps of depth and normal errors.", {16, 8192});
  }
};

/// Casts the rays of a panorama from its true pose into the model (Visibility::Look) and compares
/// depth and normals with the truth's. `home_from_truth` takes the truth's world to the model's
/// frame. Left out are pixels without truth and those that the truth labels as furniture. Where a
/// ray passes a door of the plan, the face behind it or the door itself counts, whichever is nearer
/// to the true depth: the plan does not say whether the door stands open.
///
/// Requires a pose, and depth or normals. Throws what the readers of pixel_truth.h throw, and
/// InvalidInputError when the truth's pictures differ in size.
[[nodiscard]] ModelErrorMap CompareModel(const BuildingModel& model, const Visibility& visibility,
                                         const Rigid3& home_from_truth, const TruthView& truth,
                                         const ModelErrorOptions& options = {});

/// Medians over the panoramas.
struct ModelErrorFigures {
  std::vector<PanoramaModelError> panoramas;  ///< in the order of the views
  std::optional<double> hit_share, depth_median_m, depth_within_5pct, normal_median_deg;
};

/// Receives the map of each panorama, from several threads at a time.
using ModelErrorSink = std::function<void(const ModelErrorMap&)>;

/// Compares the model with every panorama whose truth has depth or normals. `floorplan` in the
/// truth's world; `truth_idx` as in EvaluateColumns. Figures that fall on pixels without a face are
/// none. Memory: one panorama's truth per thread.
[[nodiscard]] ModelErrorFigures EvaluateModel(const BuildingModel& model,
                                              const Floorplan& floorplan, const GroundTruth& truth,
                                              std::span<const int> truth_idx,
                                              const ModelErrorOptions& options,
                                              const ModelErrorSink& sink, RunContext& context);

}  // namespace enfilade
