// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/heading.h"

#include <algorithm>
#include <cmath>

#include "enfilade/geometry/angles.h"
#include "enfilade/structure/types.h"

namespace enfilade {
namespace {

// A line's plane must be this far from vertical, so that vertical edges do not vote …
constexpr double kMinNormalZ = 0.25;
// … and this far from level, so that its horizontal direction is well defined.
constexpr double kMinNormalXY = 0.25;
constexpr double kMaxElevation_rad = DegToRad(65);
// How far about the peak the refinement looks, in kernels.
constexpr double kRefineKernels = 3;

float Gray(const ImageU8& rgb, int r, int c) {
  return 0.299F * rgb(r, c, 0) + 0.587F * rgb(r, c, 1) + 0.114F * rgb(r, c, 2);
}

int NumBins(const HeadingOptions& options) {
  return std::max(8, static_cast<int>(std::lround(90.0 / options.bin_deg)));
}

}  // namespace

HeadingHistogram VoteHeading(const LevelPanorama& panorama, const HeadingOptions& options) {
  const int rows = panorama.rows(), cols = panorama.cols();
  const int num_bins = NumBins(options);
  HeadingHistogram histogram(static_cast<size_t>(num_bins), 0.0);
  for (int r = 1; r + 1 < rows; ++r) {
    const double elevation = kPi * (0.5 - (r + 0.5) / rows);
    if (std::abs(elevation) > kMaxElevation_rad) continue;
    const double cos_el = std::cos(elevation), sin_el = std::sin(elevation);
    for (int c = 0; c < cols; ++c) {
      const int left = c > 0 ? c - 1 : cols - 1, right = c + 1 < cols ? c + 1 : 0;
      if (!panorama.is_seen(r - 1, c) || !panorama.is_seen(r + 1, c) ||
          !panorama.is_seen(r, left) || !panorama.is_seen(r, right)) {
        continue;
      }
      // Gradient on the sphere: columns shrink with the cosine of the elevation.
      const double along_azimuth =
          0.5 * (Gray(panorama.rgb, r, right) - Gray(panorama.rgb, r, left)) / cos_el;
      const double along_elevation =
          0.5 * (Gray(panorama.rgb, r - 1, c) - Gray(panorama.rgb, r + 1, c));
      const double strength = std::hypot(along_azimuth, along_elevation);
      if (strength < options.min_gradient) continue;
      const double azimuth = AzimuthOfColumn(c, cols);
      const Eigen::Vector3d east(-std::sin(azimuth), std::cos(azimuth), 0);
      const Eigen::Vector3d up(-sin_el * std::cos(azimuth), -sin_el * std::sin(azimuth), cos_el);
      // The gradient is the normal of the plane through the camera and the edge.
      const Eigen::Vector3d normal = (along_azimuth * east + along_elevation * up) / strength;
      const double normal_xy = std::hypot(normal.x(), normal.y());
      if (std::abs(normal.z()) < kMinNormalZ || normal_xy < kMinNormalXY) continue;
      const double heading_deg = RadToDeg(WrapQuarter(std::atan2(-normal.x(), normal.y())));
      const int bin =
          std::clamp(static_cast<int>((heading_deg + 45.0) / 90.0 * num_bins), 0, num_bins - 1);
      // Strong edges say little more than clear ones: the vote saturates. A pixel covers cos φ.
      histogram[static_cast<size_t>(bin)] +=
          cos_el * normal_xy * std::min(strength, 4 * options.min_gradient);
    }
  }
  return histogram;
}

double HeadingOfHistogram(const HeadingHistogram& histogram, const HeadingOptions& options) {
  const int num_bins = static_cast<int>(histogram.size());
  if (num_bins == 0) return 0;
  const double bin_deg = 90.0 / num_bins;
  const int radius = static_cast<int>(std::ceil(4 * options.kernel_deg / bin_deg));
  const auto at = [&](int i) {
    return histogram[static_cast<size_t>(((i % num_bins) + num_bins) % num_bins)];
  };
  int best = 0;
  double best_score = 0;
  for (int i = 0; i < num_bins; ++i) {
    double score = 0;
    for (int k = -radius; k <= radius; ++k) {
      const double x = k * bin_deg / options.kernel_deg;
      score += std::exp(-0.5 * x * x) * at(i + k);
    }
    if (score > best_score) {
      best_score = score;
      best = i;
    }
  }
  if (best_score == 0) return 0;
  // Mean about the peak of what rises above the background.
  const int reach = static_cast<int>(std::ceil(kRefineKernels * options.kernel_deg / bin_deg));
  double background = 1e300;
  for (int k = -reach; k <= reach; ++k) background = std::min(background, at(best + k));
  double weight = 0, mean = 0;
  for (int k = -reach; k <= reach; ++k) {
    const double w = at(best + k) - background;
    weight += w;
    mean += w * k;
  }
  const double offset = weight > 0 ? mean / weight : 0.0;
  return WrapQuarter(DegToRad(-45.0 + (best + 0.5 + offset) * bin_deg));
}

}  // namespace enfilade
