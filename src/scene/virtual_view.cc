// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/scene/virtual_view.h"

#include <algorithm>
#include <vector>

#include "enfilade/base/check.h"
#include "enfilade/scene/locate_rays.h"

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Where the pixels of one row of the view lie in the panorama (LocateRays).
struct RowPositions {
  std::vector<float> u, v;
};

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
    LocateRays(pano_from_view * first, step, pano.cols(), pano.rows(), row.u, row.v);
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
