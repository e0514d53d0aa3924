// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// True for points with a finite position, a unit normal and at least one view.
[[nodiscard]] bool IsOriented(const ScenePoint& point);

/// A point on a surface that a camera saw, in the home frame.
struct SurfaceSample {
  Eigen::Vector3d position;
  Eigen::Vector3d normal;  ///< unit, on the camera's side
  Eigen::Vector3d camera;
};

/// One sample for each oriented point and view that sees it within `max_range_m`, in their order.
[[nodiscard]] std::vector<SurfaceSample> SamplesOf(const Scene& scene, const Structure& structure,
                                                   const std::vector<ScenePoint>& points,
                                                   double max_range_m);

/// One sample for each cube of `spacing_m` and axis that normals are nearest to: the mean of those
/// in it, with the camera of the first. In the order of the cubes.
[[nodiscard]] std::vector<SurfaceSample> Thinned(const std::vector<SurfaceSample>& samples,
                                                 double spacing_m);

/// Why there are too few samples for a surface; empty when there are enough.
[[nodiscard]] std::string ReasonForTooFew(const std::vector<SurfaceSample>& samples);

}  // namespace enfilade
