// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/scene/virtual_view.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// atan(x) for x in [0, 1] with an error below 2e-8 (Abramowitz and Stegun 1964, 4.4.49).
inline float AtanUnit(float x) {
  const float t = x * x;
  float p = 0.0028662257f;
  p = p * t - 0.0161657367f;
  p = p * t + 0.0429096138f;
  p = p * t - 0.0752896400f;
  p = p * t + 0.1065626393f;
  p = p * t - 0.1420889944f;
  p = p * t + 0.1999355085f;
  p = p * t - 0.3333314528f;
  return x + x * (t * p);
}

// std::atan2 without branches, so that the compiler makes vector code of the loop round it.
inline float FastAtan2(float y, float x) {
  constexpr float kFloatPi = static_cast<float>(kPi);
  const float abs_x = std::abs(x), abs_y = std::abs(y);
  const float larger = std::max(std::max(abs_x, abs_y), 1e-30f);  // 0/0 at the poles
  float angle = AtanUnit(std::min(abs_x, abs_y) / larger);
  angle = abs_y > abs_x ? 0.5f * kFloatPi - angle : angle;
  angle = x < 0 ? kFloatPi - angle : angle;
  return y < 0 ? -angle : angle;
}

// Where the pixels of one row of the view lie in the panorama, in pixels from the centre of the
// top-left pixel: u in [−½, cols − ½], v in [−½, rows − ½].
struct RowPositions {
  std::vector<float> u, v;
};

// `first` is the ray of the row's first pixel, `step` the change from pixel to pixel.
void LocateRow(const Vector3d& first, const Vector3d& step, int pano_cols, int pano_rows,
               RowPositions& row) {
  const int size = static_cast<int>(row.u.size());
  const float x0 = static_cast<float>(first.x()), dx = static_cast<float>(step.x());
  const float y0 = static_cast<float>(first.y()), dy = static_cast<float>(step.y());
  const float z0 = static_cast<float>(first.z()), dz = static_cast<float>(step.z());
  const float u_per_rad = static_cast<float>(pano_cols / (2 * kPi));
  const float v_per_rad = static_cast<float>(pano_rows / kPi);
  const float u_center = 0.5f * static_cast<float>(pano_cols) - 0.5f;
  const float v_center = 0.5f * static_cast<float>(pano_rows) - 0.5f;
  float* u = row.u.data();
  float* v = row.v.data();
  for (int i = 0; i < size; ++i) {
    const float t = static_cast<float>(i);
    const float x = x0 + t * dx, y = y0 + t * dy, z = z0 + t * dz;
    u[i] = u_center + u_per_rad * FastAtan2(x, z);
    v[i] = v_center + v_per_rad * FastAtan2(y, std::sqrt(x * x + z * z));
  }
}

// Bilinear in fixed point: weights of 11 bits, so a product of two and a value of 8 fit in 30.
template <int kChannels>
void SampleRow(const ImageU8& pano, const RowPositions& row, uint8_t* out) {
  constexpr int kBits = 11;
  constexpr int kOne = 1 << kBits;
  const int cols = pano.cols();
  const float max_v = static_cast<float>(pano.rows() - 1);
  for (size_t i = 0; i < row.u.size(); ++i, out += kChannels) {
    const float v = std::clamp(row.v[i], 0.0f, max_v);
    int col = static_cast<int>(row.u[i] + 1) - 1;  // rounds down from −½, too
    const int top = static_cast<int>(v);
    const int wx = static_cast<int>((row.u[i] - static_cast<float>(col)) * kOne + 0.5f);
    const int wy = static_cast<int>((v - static_cast<float>(top)) * kOne + 0.5f);
    col = col < 0 ? col + cols : col;
    col = col >= cols ? col - cols : col;
    const int next_col = col + 1 < cols ? col + 1 : 0;
    const uint8_t* above = pano.row(top);
    const uint8_t* below = pano.row(std::min(top + 1, pano.rows() - 1));
    for (int k = 0; k < kChannels; ++k) {
      const int left = col * kChannels + k, right = next_col * kChannels + k;
      const int a = (kOne - wx) * above[left] + wx * above[right];
      const int b = (kOne - wx) * below[left] + wx * below[right];
      out[k] =
          static_cast<uint8_t>(((kOne - wy) * a + wy * b + (1 << (2 * kBits - 1))) >> (2 * kBits));
    }
  }
}

template <int kChannels>
ImageU8 Render(const ImageU8& pano, const Camera& view, const Matrix3d& pano_from_view) {
  ImageU8 image(view.height, view.width, kChannels);
  const size_t width = static_cast<size_t>(view.width);
  RowPositions row{std::vector<float>(width), std::vector<float>(width)};
  const Vector3d step = pano_from_view * Vector3d(1 / view.fx, 0, 0);
  for (int r = 0; r < view.height; ++r) {
    const Vector3d first((0.5 - view.cx) / view.fx, (r + 0.5 - view.cy) / view.fy, 1);
    LocateRow(pano_from_view * first, step, pano.cols(), pano.rows(), row);
    SampleRow<kChannels>(pano, row, image.row(r));
  }
  return image;
}

}  // namespace

ImageU8 RenderVirtualView(const ImageU8& pano, const Camera& pano_camera, const Camera& view,
                          const Matrix3d& pano_from_view) {
  ENFILADE_CHECK(pano_camera.model == CameraModel::kEquirectangular);
  ENFILADE_CHECK(view.model == CameraModel::kPinhole);
  ENFILADE_CHECK(pano.cols() == pano_camera.width && pano.rows() == pano_camera.height);
  ENFILADE_CHECK(pano.channels() == 1 || pano.channels() == 3);
  return pano.channels() == 1 ? Render<1>(pano, view, pano_from_view)
                              : Render<3>(pano, view, pano_from_view);
}

}  // namespace enfilade
