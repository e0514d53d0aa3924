// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "enfilade/image/image.h"
#include "enfilade/scene/camera.h"

namespace enfilade {

/// Renders what a pinhole camera at the panorama's centre sees: view.height × view.width pixels
/// with the panorama's channels. `pano_from_view` turns rays of the view's camera frame into the
/// panorama's; both are x right, y down, z forward.
///
/// Bilinear, wrapping round the back of the panorama and clamped at its poles. Sampling positions
/// are right to 1/500 pixel of panoramas up to 16384 pixels wide, values to one grey level. There
/// is no low-pass filter: where the view is coarser than the panorama (view.fx below
/// pano.cols() / 2π pixels), scale the panorama down first.
///
/// Uses the calling thread only: many views are rendered by ParallelFor over views. Cost: view
/// pixels. The panorama must have the size of `pano_camera`, which is equirectangular, and `view`
/// must be a pinhole camera (std::logic_error otherwise).
[[nodiscard]] ImageU8 RenderVirtualView(const ImageU8& pano, const Camera& pano_camera,
                                        const Camera& view, const Eigen::Matrix3d& pano_from_view);

}  // namespace enfilade
