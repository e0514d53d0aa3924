// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "enfilade/base/run_context.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/geometry/rigid3.h"
#include "enfilade/image/image.h"
#include "enfilade/model/types.h"
#include "enfilade/scene/camera.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// The model from outside and above, in parallel projection, as RGB of about `width_px` columns in
/// the proportions of `extent`. Surfaces are seen from their front only: ceilings and the nearer
/// walls show their back and are not there, so the rooms lie open. Shaded by the normal, with a
/// line where surfaces meet; what is outside `extent` (home frame, metres) may be cut off. White
/// where there is nothing. Cost: rays × surfaces passed.
[[nodiscard]] ImageU8 RenderFromOutside(const BuildingModel& model,
                                        const Eigen::AlignedBox3d& extent, int width_px,
                                        RunContext& context);

/// Where a picture of a model from inside is taken.
struct InsideView {
  int view_idx = 0;  ///< of the panorama there, into the scene
  Rigid3 home_from_cam;
  Camera camera;
};

/// A level pinhole camera of 95° at the panorama (at a pinhole picture if there is none) whose
/// walls stand farthest away, in the median, towards where they do. `structure` has a profile.
[[nodiscard]] InsideView ChooseInsideView(const Scene& scene, const Structure& structure,
                                          int width_px);

/// What a pinhole camera sees of the model (Visibility::Look): doors stand shut and brown, openings
/// are open, what has no surface is dark. `home_from_cam` as in conventions.md.
[[nodiscard]] ImageU8 RenderFromInside(const BuildingModel& model, const Floorplan& plan,
                                       const Rigid3& home_from_cam, const Camera& camera,
                                       RunContext& context);

}  // namespace enfilade
