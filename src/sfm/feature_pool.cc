// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/feature_pool.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "src/sfm/pixel_of_ray.h"

namespace enfilade {
namespace {

constexpr size_t kDimension = kDescriptorSize;
constexpr float kScale = kDescriptorScale;
constexpr float kLargest = kMaxDescriptorValue;

}  // namespace

void FeaturePool::Add(int view_idx, const Eigen::Vector2d& pixel, double size_px, double strength,
                      const float* root_sift) {
  const Eigen::Vector3d ray_in_view = ring_.camera.RayFromPixel(pixel);
  const Eigen::Vector3d ray = ring_.pano_from_view[static_cast<size_t>(view_idx)] * ray_in_view;
  if (!ring_.Owns(view_idx, ray) || *PixelOfRay(trusted_, pano_, ray) == 0) return;
  rays_.push_back(ray.cast<float>());
  strengths_.push_back(static_cast<float>(strength));
  views_.push_back(static_cast<uint8_t>(view_idx));
  // A pixel subtends less towards the border of a plane picture.
  sizes_rad_.push_back(
      static_cast<float>(size_px * ring_.pixel_rad() * ray_in_view.z() * ray_in_view.z()));
  for (size_t k = 0; k < kDimension; ++k) {
    descriptors_.push_back(
        static_cast<uint8_t>(std::clamp(root_sift[k] * kScale + 0.5F, 0.0F, kLargest)));
  }
}

PanoFeatures FeaturePool::Take(int max_features) {
  std::vector<size_t> order(rays_.size());
  std::iota(order.begin(), order.end(), size_t{0});
  // Equal keys are one feature with two orientations: their descriptors decide.
  const auto descriptor = [&](size_t i) {
    return descriptors_.begin() + static_cast<long>(i * kDimension);
  };
  const auto is_before = [&](size_t i, size_t j) {
    const auto key = [&](size_t k) {
      return std::make_tuple(-sizes_rad_[k], rays_[k].x(), rays_[k].y(), rays_[k].z());
    };
    if (key(i) != key(j)) return key(i) < key(j);
    return std::lexicographical_compare(descriptor(i), descriptor(i) + kDimension, descriptor(j),
                                        descriptor(j) + kDimension);
  };
  std::sort(order.begin(), order.end(), is_before);
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t i, size_t j) { return strengths_[i] > strengths_[j]; });
  order.resize(std::min(order.size(), static_cast<size_t>(max_features)));
  std::sort(order.begin(), order.end(), is_before);
  PanoFeatures features;
  for (const size_t i : order) {
    features.rays.push_back(rays_[i]);
    features.sizes_rad.push_back(sizes_rad_[i]);
    features.walls.push_back(views_[i]);
    features.descriptors.values.insert(features.descriptors.values.end(), descriptor(i),
                                       descriptor(i) + kDimension);
  }
  return features;
}

}  // namespace enfilade
