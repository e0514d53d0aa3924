// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/image/image.h"

namespace enfilade {

/// The picture, in the size of the labels, tinted by them: floor green, wall red, ceiling blue, not
/// known untinted. `picture` is RGB of any size, `labels` SurfaceLabels.
[[nodiscard]] ImageU8 TintByLabels(const ImageU8& picture, const ImageU8& labels);

}  // namespace enfilade
