// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/image/image.h"

namespace enfilade {

/// Euclidean distance in pixels from each pixel's centre to the centre of the nearest non-zero
/// pixel of `mask` (0 on it; infinity everywhere when the mask has none). Exact, O(pixels):
/// Felzenszwalb & Huttenlocher, "Distance Transforms of Sampled Functions" (2012).
[[nodiscard]] ImageF DistanceToMask(const ImageU8& mask);

/// Erosion, dilation and opening of the non-zero pixels by a disc; the result is 0 or 1. Outside
/// the picture counts as zero.
[[nodiscard]] ImageU8 ErodeByDisc(const ImageU8& mask, double radius_px);
[[nodiscard]] ImageU8 DilateByDisc(const ImageU8& mask, double radius_px);
[[nodiscard]] ImageU8 OpenByDisc(const ImageU8& mask, double radius_px);

}  // namespace enfilade
