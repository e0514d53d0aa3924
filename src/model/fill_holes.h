// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/image/image.h"

namespace enfilade {

/// Gives every pixel with weight 0 a smooth colour from those around it: averages go down a pyramid
/// and come back bilinearly (push-pull, after Gortler et al., "The lumigraph", 1996). `rgbw` has
/// four channels, the last being the weight; pixels with a weight keep their colour. Returns false,
/// leaving the picture, when no pixel has one.
[[nodiscard]] bool FillHoles(ImageF& rgbw);

}  // namespace enfilade
