// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/line_response.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/structure/types.h"
#include "src/structure/seen_margin.h"

namespace enfilade {
namespace {

constexpr double kMaxElevation_rad = DegToRad(82);
// Gaussian under which derivatives are taken, pixels.
constexpr double kDerivativeSigma_px = 0.8;
// The two sides of an edge differ; those of a joint between tiles do not. Gaussian and distance
// from the edge at which they are compared, pixels.
constexpr double kStepSigma_px = 1.2;
constexpr int kStepReach_px = 4;
// A gradient counts up to so many times the difference of the sides.
constexpr float kStepShare = 2.0F;
// Pixels that a derivative looks at on either side.
constexpr int kDerivativeReach_px = 4;
// Half size of the box over which the local mean of the gradients is taken, as a share of the rows.
constexpr double kNoiseBoxShare = 0.02;

// Derivatives (∂x, ∂y) of luminance and of two opponent colours at one pixel in fixed point; two
// entries are padding, so that a pixel is one vector register.
using GradientPixel = std::array<int16_t, 8>;
constexpr int kNumChannels = 3;
// Fixed point: a sum over the longest line of the largest gradients must fit 16 bits.
constexpr float kGradientScale = 3.0F;
constexpr int kMaxHalfLength_px = 10;

struct Gradients {
  int rows, cols;
  std::vector<GradientPixel> pixels;
  [[nodiscard]] const GradientPixel& operator()(int r, int c) const {
    return pixels[static_cast<size_t>(r) * static_cast<size_t>(cols) + static_cast<size_t>(c)];
  }
};

// Luminance first; opponent colours are weighed so that noise is about the same in each.
void ToOpponent(const uint8_t* rgb, float* opponent) {
  const float red = rgb[0], green = rgb[1], blue = rgb[2];
  opponent[0] = 0.299F * red + 0.587F * green + 0.114F * blue;
  opponent[1] = 0.5F * (red - green);
  opponent[2] = 0.25F * (red + green) - 0.5F * blue;
}

constexpr int kPad = 8;  // columns by which a picture wraps round in azimuth, on either side

cv::Mat OpponentPicture(const LevelPanorama& panorama) {
  const int rows = panorama.rows(), cols = panorama.cols();
  cv::Mat opponent(rows, cols + 2 * kPad, CV_32FC3);
  for (int r = 0; r < rows; ++r) {
    float* out = opponent.ptr<float>(r);
    for (int c = -kPad; c < cols + kPad; ++c, out += 3) {
      ToOpponent(panorama.rgb.row(r) + 3 * ((c + cols) % cols), out);
    }
  }
  return opponent;
}

// Differences over `step` pixels either way of what a Gaussian has smoothed; none where not seen.
Gradients ComputeGradients(const cv::Mat& opponent, const ImageU8& seen, double sigma_px,
                           int step) {
  const int rows = seen.rows(), cols = seen.cols();
  cv::Mat smooth;
  cv::GaussianBlur(opponent, smooth, {0, 0}, sigma_px);
  Gradients gradients{
      rows, cols,
      std::vector<GradientPixel>(static_cast<size_t>(rows) * static_cast<size_t>(cols))};
  for (int r = step; r + step < rows; ++r) {
    const float* here = smooth.ptr<float>(r) + 3 * kPad;
    const float* above = smooth.ptr<float>(r - step) + 3 * kPad;
    const float* below = smooth.ptr<float>(r + step) + 3 * kPad;
    GradientPixel* out =
        gradients.pixels.data() + static_cast<size_t>(r) * static_cast<size_t>(cols);
    for (int c = 0; c < cols; ++c, ++out) {
      if (!seen(r, c)) continue;  // the border of the unseen part is no line
      for (int k = 0; k < kNumChannels; ++k) {
        (*out)[static_cast<size_t>(2 * k)] = static_cast<int16_t>(
            kGradientScale * (here[3 * (c + step) + k] - here[3 * (c - step) + k]));
        (*out)[static_cast<size_t>(2 * k + 1)] =
            static_cast<int16_t>(kGradientScale * (below[3 * c + k] - above[3 * c + k]));
      }
    }
  }
  return gradients;
}

// Direction, in pixels, of the image of a horizontal line that makes the angle with sine and cosine
// `sin_off`, `cos_off` with the column's azimuth, at one elevation.
Eigen::Vector2d LineDirection(double sin_off, double cos_off, double sin_elevation,
                              double cos_elevation) {
  // Columns shrink with cos φ; rows count downwards.
  const double x = sin_off / cos_elevation, y = sin_elevation * cos_off;
  const double length = std::sqrt(x * x + y * y);
  return {x / length, y / length};
}

// Strength of the averaged gradient across the line, grey levels.
float AverageAcross(const Gradients& gradients, int row, int col, const Eigen::Vector2d& along,
                    int half_length) {
  constexpr int kOne = 1 << 16;
  const int step_x = static_cast<int>(along.x() * kOne),
            step_y = static_cast<int>(along.y() * kOne);
  int x = col * kOne + kOne / 2 - half_length * step_x,
      y = row * kOne + kOne / 2 - half_length * step_y;
  GradientPixel sum{};
  for (int s = -half_length; s <= half_length; ++s, x += step_x, y += step_y) {
    const int r = std::clamp(y >> 16, 0, gradients.rows - 1);
    int c = x >> 16;
    c = c < 0 ? c + gradients.cols : c >= gradients.cols ? c - gradients.cols : c;
    const GradientPixel& g = gradients(r, c);
    for (size_t k = 0; k < g.size(); ++k) sum[k] = static_cast<int16_t>(sum[k] + g[k]);
  }
  const float normal_x = static_cast<float>(-along.y()), normal_y = static_cast<float>(along.x());
  float squared = 0;
  for (size_t k = 0; k < kNumChannels; ++k) {
    const float across = normal_x * sum[2 * k] + normal_y * sum[2 * k + 1];
    squared += across * across;
  }
  return std::sqrt(squared) / (kGradientScale * static_cast<float>(2 * half_length + 1));
}

// `usual` is what the strength is measured by: joints between tiles are no lines, but a floor full
// of them is no quiet one.
ImageU8 Normalise(const ImageF& strength, const ImageF& usual, const LineResponseOptions& options) {
  const int rows = strength.rows(), cols = strength.cols();
  const int half = std::max(2, static_cast<int>(std::lround(kNoiseBoxShare * rows)));
  cv::Mat source(rows, cols, CV_32F, const_cast<float*>(usual.data().data()));
  cv::Mat padded, mean;
  cv::copyMakeBorder(source, padded, 0, 0, half, half, cv::BORDER_WRAP);
  cv::blur(padded, mean, {2 * half + 1, 2 * half + 1});
  ImageU8 response(rows, cols);
  for (int r = 0; r < rows; ++r) {
    const float* local_mean = mean.ptr<float>(r) + half;
    for (int c = 0; c < cols; ++c) {
      const float g = strength(r, c);
      const float noise =
          static_cast<float>(options.noise_floor + options.noise_factor * local_mean[c]);
      response(r, c) = static_cast<uint8_t>(255.0F * g * g / (g * g + noise * noise));
    }
  }
  return response;
}

}  // namespace

double WallDirection(int family, double column_azimuth_rad) {
  static constexpr double kDirections[kNumPlaneFamilies] = {0, kPi / 2, kPi / 4, 3 * kPi / 4};
  return family == kFrontalFamily ? column_azimuth_rad + kPi / 2 : kDirections[family];
}

LineResponse ComputeLineResponse(const LevelPanorama& panorama, int num_columns,
                                 std::span<const int> families,
                                 const LineResponseOptions& options) {
  const int rows = panorama.rows(), cols = panorama.cols();
  ENFILADE_CHECK(num_columns > 0 && cols % num_columns == 0);
  ENFILADE_CHECK(options.half_length_px <= kMaxHalfLength_px);
  const int step = cols / num_columns;
  const cv::Mat opponent = OpponentPicture(panorama);
  const ImageU8 seen = SeenWithMargin(panorama, kDerivativeReach_px);
  const Gradients gradients = ComputeGradients(opponent, seen, kDerivativeSigma_px, 1);
  const Gradients steps = ComputeGradients(opponent, seen, kStepSigma_px, kStepReach_px);
  LineResponse response{std::vector<ImageU8>(kNumFamilies)};
  for (const int family : families) {
    std::vector<double> sin_off, cos_off;
    for (int c = 0; c < num_columns; ++c) {
      const double azimuth = AzimuthOfColumn(c, num_columns);
      sin_off.push_back(std::sin(WallDirection(family, azimuth) - azimuth));
      cos_off.push_back(std::cos(WallDirection(family, azimuth) - azimuth));
    }
    ImageF strength(rows, num_columns), usual(rows, num_columns);
    for (int r = 0; r < rows; ++r) {
      const double elevation = kPi * (0.5 - (r + 0.5) / rows);
      if (std::abs(elevation) > kMaxElevation_rad) continue;
      const double sin_elevation = std::sin(elevation), cos_elevation = std::cos(elevation);
      for (int c = 0; c < num_columns; ++c) {
        const Eigen::Vector2d along =
            LineDirection(sin_off[static_cast<size_t>(c)], cos_off[static_cast<size_t>(c)],
                          sin_elevation, cos_elevation);
        const int col = c * step + step / 2;
        const float fine = AverageAcross(gradients, r, col, along, options.half_length_px);
        const float coarse = AverageAcross(steps, r, col, along, options.half_length_px);
        strength(r, c) = std::min(fine, kStepShare * coarse);
        usual(r, c) = fine;
      }
    }
    response.family[static_cast<size_t>(family)] = Normalise(strength, usual, options);
  }
  return response;
}

}  // namespace enfilade
