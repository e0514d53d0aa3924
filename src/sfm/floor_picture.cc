// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/floor_picture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "enfilade/scene/virtual_view.h"
#include "src/sfm/to_gray.h"
#include "src/sfm/wall_view.h"

namespace enfilade {
namespace {

constexpr int kSide = FloorPicture::kSide;
// Half a metre or so: wider than a board or a tile's joint, narrower than a shadow.
constexpr int kNearby_px = 17;
// Variance of grey values that the camera's noise has; what varies less is plain.
constexpr float kNoiseVariance = 2;
constexpr uint8_t kTrusted = 255;

cv::Mat Nearby(const cv::Mat& values) {
  cv::Mat mean;
  cv::boxFilter(values, mean, CV_32F, {kNearby_px, kNearby_px}, {-1, -1}, true,
                cv::BORDER_CONSTANT);
  return mean;
}

}  // namespace

bool FloorPicture::IsShown(int row, int col) {
  const double distance = std::hypot(row - kReach, col - kReach);
  return distance > kNearest && distance < kReach;
}

FloorPicture LookAtFloor(const ImageU8& panorama, const ImageU8& trusted, const Camera& camera,
                         const Eigen::Matrix3d& pano_from_walls) {
  const Camera from_above = PinholeCamera(kSide, kSide, FloorPicture::kPixelsPerHeight,
                                          FloorPicture::kPixelsPerHeight, kSide / 2.0, kSide / 2.0);
  const Eigen::Matrix3d pano_from_view = pano_from_walls * WallViewFrame(kFloorWallView);
  const ImageU8 floor = RenderVirtualView(ToGray(panorama), camera, from_above, pano_from_view);
  const ImageU8 known = RenderVirtualView(trusted, camera, from_above, pano_from_view);
  cv::Mat value(kSide, kSide, CV_32F), weight(kSide, kSide, CV_32F);
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) {
      const bool is_known = FloorPicture::IsShown(r, c) && known(r, c) == kTrusted;
      weight.at<float>(r, c) = is_known ? 1.0F : 0.0F;
      value.at<float>(r, c) = is_known ? static_cast<float>(floor(r, c)) : 0.0F;
    }
  }
  const cv::Mat share = Nearby(weight), mean = Nearby(value), square = Nearby(value.mul(value));
  FloorPicture picture;
  picture.contrast = Image<int8_t>(kSide, kSide);
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) {
      if (weight.at<float>(r, c) <= 0) continue;
      const float middle = mean.at<float>(r, c) / share.at<float>(r, c);
      const float variance =
          std::max(0.0F, square.at<float>(r, c) / share.at<float>(r, c) - middle * middle);
      const double contrast = FloorPicture::kScale * (value.at<float>(r, c) - middle) /
                              std::sqrt(variance + kNoiseVariance);
      picture.contrast(r, c) =
          static_cast<int8_t>(std::lround(std::clamp(contrast, -127.0, 127.0)));
    }
  }
  return picture;
}

}  // namespace enfilade
