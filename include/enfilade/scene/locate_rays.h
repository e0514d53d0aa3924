// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>

namespace enfilade {

/// Where rays lie in an equirectangular picture, as many as `u` and `v` hold: ray i is
/// first + i · step in the camera's frame (x right, y down, z forward), of any length but zero. In
/// pixels from the *centre* of the top-left pixel: u in [−½, cols − ½], v in [−½, rows − ½].
///
/// The same as Camera::PixelFromRay less ½, in single precision and several rays at once: right to
/// 1/500 pixel of pictures up to 16384 pixels wide.
void LocateRays(const Eigen::Vector3d& first, const Eigen::Vector3d& step, int cols, int rows,
                std::span<float> u, std::span<float> v);

}  // namespace enfilade
