// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "enfilade/image/image.h"
#include "src/synthetic/random.h"

namespace enfilade {

/// What a lens and a sensor make of an ideal picture with values in [0, 255]: a Gaussian blur of
/// `blur_px` (`wraps`: the columns wrap round, as in a panorama), Gaussian noise of `noise` grey
/// levels, rounding.
[[nodiscard]] ImageU8 ExposeSensor(ImageF ideal, double blur_px, double noise, bool wraps,
                                   uint64_t seed);

}  // namespace enfilade
