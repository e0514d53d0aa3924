// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/image/image.h"

namespace enfilade {

/// The picture with fewer pixels, each the mean of the area that it covers. For a side that grows
/// values are interpolated. No side may be zero.
[[nodiscard]] ImageU8 ReduceImage(const ImageU8& image, int rows, int cols);

}  // namespace enfilade
