// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/colmap_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "enfilade/base/errors.h"

namespace enfilade {
namespace {

constexpr int kSimplePinhole = 0;
constexpr int kPinhole = 1;
constexpr int kEquirectangular = 17;
constexpr uint64_t kMaxSide_px = 1000000;

// In the order of their ids (COLMAP 4.1).
constexpr std::array<std::string_view, 18> kModelNames = {"SIMPLE_PINHOLE",
                                                          "PINHOLE",
                                                          "SIMPLE_RADIAL",
                                                          "RADIAL",
                                                          "OPENCV",
                                                          "OPENCV_FISHEYE",
                                                          "FULL_OPENCV",
                                                          "FOV",
                                                          "SIMPLE_RADIAL_FISHEYE",
                                                          "RADIAL_FISHEYE",
                                                          "THIN_PRISM_FISHEYE",
                                                          "RAD_TAN_THIN_PRISM_FISHEYE",
                                                          "SIMPLE_DIVISION",
                                                          "DIVISION",
                                                          "SIMPLE_FISHEYE",
                                                          "FISHEYE",
                                                          "EUCM",
                                                          "EQUIRECTANGULAR"};

}  // namespace

int ColmapModelId(const std::string& name) {
  const auto it = std::find(kModelNames.begin(), kModelNames.end(), name);
  return it == kModelNames.end() ? -1 : static_cast<int>(it - kModelNames.begin());
}

int NumColmapParams(int model_id, const std::string& where) {
  if (model_id == kSimplePinhole) return 3;
  if (model_id == kPinhole) return 4;
  if (model_id == kEquirectangular) return 2;
  const bool is_known = model_id >= 0 && model_id < static_cast<int>(kModelNames.size());
  throw InvalidInputError(where,
                          "has a camera of model " +
                              (is_known ? std::string(kModelNames[static_cast<size_t>(model_id)])
                                        : "number " + std::to_string(model_id)) +
                              ", only EQUIRECTANGULAR, PINHOLE and SIMPLE_PINHOLE are supported",
                          "undistort the pictures first (colmap image_undistorter)");
}

Camera MakeColmapCamera(int model_id, uint64_t width, uint64_t height,
                        const std::vector<double>& params, const std::string& where) {
  if (width == 0 || height == 0 || width > kMaxSide_px || height > kMaxSide_px) {
    throw InvalidInputError(where, "has a camera without a sensible size",
                            "check that the model is complete");
  }
  const int w = static_cast<int>(width), h = static_cast<int>(height);
  if (model_id == kEquirectangular) return EquirectangularCamera(w, h);
  const bool is_simple = model_id == kSimplePinhole;
  const double fx = params[0], fy = params[is_simple ? 0 : 1];
  const double cx = params[is_simple ? 1 : 2], cy = params[is_simple ? 2 : 3];
  if (!(std::isfinite(fx) && std::isfinite(fy) && fx > 0 && fy > 0 && std::isfinite(cx) &&
        std::isfinite(cy))) {
    throw InvalidInputError(where, "has a camera without a sensible focal length",
                            "check that the model is complete");
  }
  return PinholeCamera(w, h, fx, fy, cx, cy);
}

ColmapIntrinsics IntrinsicsOf(const Camera& camera) {
  const bool is_pinhole = camera.model == CameraModel::kPinhole;
  const int model_id = is_pinhole ? kPinhole : kEquirectangular;
  const std::string name(kModelNames[static_cast<size_t>(model_id)]);
  if (is_pinhole) return {model_id, name, {camera.fx, camera.fy, camera.cx, camera.cy}};
  return {model_id, name, {static_cast<double>(camera.width), static_cast<double>(camera.height)}};
}

}  // namespace enfilade
