// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/heading.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "enfilade/geometry/angles.h"
#include "enfilade/structure/types.h"
#include "src/structure/seen_margin.h"

namespace enfilade {
namespace {

// A line's plane must be this far from vertical, so that vertical edges do not vote …
constexpr double kMinNormalZ = 0.25;
// … and this far from level, so that its horizontal direction is well defined.
constexpr double kMinNormalXY = 0.25;
constexpr double kMaxElevation_rad = DegToRad(65);
// How far about the peak the refinement looks, in kernels.
constexpr double kRefineKernels = 3;

// Standard deviation of the smoothing before derivatives are taken. Differences between
// neighbouring pixels of a sharp edge prefer the directions of the pixel grid: unsmoothed, the
// heading of a room drawn without noise errs by up to 19°, with 2 px by less than 0.1°.
constexpr double kSmoothing_px = 2.0;
// Unseen pixels reach as far into the smoothed picture.
constexpr int kSmoothingReach_px = 6;

// The smoothed luminance with `pad` columns more on either side, wrapped round.
cv::Mat SmoothGray(const LevelPanorama& panorama, int pad) {
  const int rows = panorama.rows(), cols = panorama.cols();
  cv::Mat gray(rows, cols + 2 * pad, CV_32F);
  for (int r = 0; r < rows; ++r) {
    float* out = gray.ptr<float>(r);
    for (int c = -pad; c < cols + pad; ++c, ++out) {
      const uint8_t* rgb = panorama.rgb.row(r) + 3 * ((c + cols) % cols);
      *out = 0.299F * rgb[0] + 0.587F * rgb[1] + 0.114F * rgb[2];
    }
  }
  cv::GaussianBlur(gray, gray, {0, 0}, kSmoothing_px);
  return gray;
}

int NumBins(const HeadingOptions& options) {
  return std::max(8, static_cast<int>(std::lround(90.0 / options.bin_deg)));
}

}  // namespace

HeadingHistogram VoteHeading(const LevelPanorama& panorama, const HeadingOptions& options) {
  const int rows = panorama.rows(), cols = panorama.cols();
  const int num_bins = NumBins(options);
  HeadingHistogram histogram(static_cast<size_t>(num_bins), 0.0);
  constexpr int kPad = kSmoothingReach_px + 2;
  const cv::Mat gray = SmoothGray(panorama, kPad);
  const ImageU8 seen = SeenWithMargin(panorama, kSmoothingReach_px);
  for (int r = 1; r + 1 < rows; ++r) {
    const double elevation = kPi * (0.5 - (r + 0.5) / rows);
    if (std::abs(elevation) > kMaxElevation_rad) continue;
    const double cos_el = std::cos(elevation), sin_el = std::sin(elevation);
    const float* above = gray.ptr<float>(r - 1) + kPad;
    const float* here = gray.ptr<float>(r) + kPad;
    const float* below = gray.ptr<float>(r + 1) + kPad;
    for (int c = 0; c < cols; ++c) {
      if (!seen(r, c)) continue;
      // Gradient on the sphere: columns shrink with the cosine of the elevation.
      const double along_azimuth = 0.5 * (here[c + 1] - here[c - 1]) / cos_el;
      const double along_elevation = 0.5 * (above[c] - below[c]);
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
