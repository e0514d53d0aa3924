// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/features.h"

#include <array>
#include <cmath>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "enfilade/base/check.h"
#include "enfilade/scene/virtual_view.h"
#include "src/sfm/feature_pool.h"
#include "src/sfm/to_gray.h"
#include "src/sfm/view_ring.h"

namespace enfilade {
namespace {

// OpenCV doubles the picture without regard to where its pixels' centres go, which shifts all
// features by a quarter of a pixel, and counts from the centre of the top-left pixel.
constexpr double kPixelShift = 0.5 - 0.25;

std::array<float, kDescriptorSize> RootSift(const float* sift) {
  float sum = 0;
  for (int k = 0; k < kDescriptorSize; ++k) sum += sift[k];
  std::array<float, kDescriptorSize> root{};
  for (int k = 0; k < kDescriptorSize; ++k) {
    root[static_cast<size_t>(k)] = sum > 0 ? std::sqrt(sift[k] / sum) : 0.0F;
  }
  return root;
}

}  // namespace

std::span<const std::string_view> EnumNames(FeatureSource) {
  static constexpr std::array<std::string_view, 3> kNames = {"auto", "colmap", "opencv"};
  return kNames;
}

PanoFeatures ExtractFeatures(const ImageU8& panorama, const ImageU8& trusted, const Camera& camera,
                             const Eigen::Matrix3d& pano_from_walls,
                             const FeatureOptions& options) {
  ENFILADE_CHECK(trusted.rows() == panorama.rows() && trusted.cols() == panorama.cols());
  const ImageU8 gray = ToGray(panorama);
  const ViewRing ring = MakeWallViews(camera, pano_from_walls);
  FeaturePool pool(camera, ring, trusted);
  const cv::Ptr<cv::SIFT> sift =
      cv::SIFT::create(0, 3, options.min_contrast, /*edgeThreshold=*/10, /*sigma=*/1.6);
  for (size_t k = 0; k < ring.pano_from_view.size(); ++k) {
    const ImageU8 view = RenderVirtualView(gray, camera, ring.camera, ring.pano_from_view[k]);
    const cv::Mat picture(view.rows(), view.cols(), CV_8U,
                          const_cast<uint8_t*>(view.data().data()));
    std::vector<cv::KeyPoint> keypoints;
    cv::Mat descriptors;
    sift->detect(picture, keypoints);
    // The views are level: a feature that stands upright needs no orientation of its own.
    for (cv::KeyPoint& keypoint : keypoints) keypoint.angle = 0;
    cv::KeyPointsFilter::removeDuplicatedSorted(keypoints);
    sift->compute(picture, keypoints, descriptors);
    for (size_t i = 0; i < keypoints.size(); ++i) {
      const cv::KeyPoint& keypoint = keypoints[i];
      pool.Add(static_cast<int>(k), {keypoint.pt.x + kPixelShift, keypoint.pt.y + kPixelShift},
               keypoint.size, keypoint.response,
               RootSift(descriptors.ptr<float>(static_cast<int>(i))).data());
    }
  }
  return pool.Take(options.max_features);
}

}  // namespace enfilade
