// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "enfilade/evaluate/model_error.h"
#include "enfilade/image/image.h"

namespace enfilade {

/// A picture of how the model fits a panorama, as the bytes of a PNG file: the panorama with the
/// edges of the model's faces, the depth error from blue (the model is 30 cm or more too near) over
/// white to red (too far), and the error of the normals from white to dark red (30° or more), each
/// with its scale. Grey is not judged, black has no face. `rgb` is the panorama in any size, empty
/// where it is gone.
[[nodiscard]] std::string RenderErrorMapPng(const ModelErrorMap& map, const ImageU8& rgb,
                                            const std::string& title);

}  // namespace enfilade
