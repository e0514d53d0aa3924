// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "enfilade/scene/camera.h"

namespace enfilade {

/// A camera as COLMAP's files describe it, besides its size.
struct ColmapIntrinsics {
  int model_id = 0;
  std::string model_name;
  std::vector<double> params;
};

/// Number of parameters of the supported models SIMPLE_PINHOLE (0), PINHOLE (1) and EQUIRECTANGULAR
/// (17); refuses the others.
[[nodiscard]] int NumColmapParams(int model_id, const std::string& where);
/// Id of a model by its name in text files; −1 when there is none.
[[nodiscard]] int ColmapModelId(const std::string& name);
[[nodiscard]] Camera MakeColmapCamera(int model_id, uint64_t width, uint64_t height,
                                      const std::vector<double>& params, const std::string& where);

/// PINHOLE with fx, fy, cx, cy or EQUIRECTANGULAR with the size.
[[nodiscard]] ColmapIntrinsics IntrinsicsOf(const Camera& camera);

}  // namespace enfilade
