// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include "enfilade/scene/virtual_view.h"

// Virtual views of 640 × 640 pixels and 90° from a panorama of 2048 × 1024, one thread. The rival
// is what one writes with OpenCV: exact positions of all pixels, then cv::remap.
namespace enfilade {
namespace {

constexpr int kViewSize = 640;

struct Setup {
  Camera pano_camera = EquirectangularCamera(2048, 1024);
  Camera view = PinholeCamera(kViewSize, kViewSize, 320, 320, 320, 320);
  ImageU8 pano = ImageU8(1024, 2048, 3);
  Eigen::Matrix3d pano_from_view =
      Eigen::AngleAxisd(2.5, Eigen::Vector3d(0.1, 1, 0.2).normalized()).toRotationMatrix();

  Setup() {
    for (size_t i = 0; i < pano.data().size(); ++i) {
      pano.data()[i] = static_cast<uint8_t>(i * 2654435761u >> 24);
    }
  }
};

void CountPixels(benchmark::State& state) {
  state.counters["Mpx/s"] = benchmark::Counter(1e-6 * kViewSize * kViewSize,
                                               benchmark::Counter::kIsIterationInvariantRate);
}

void BM_RenderVirtualView(benchmark::State& state) {
  const Setup setup;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        RenderVirtualView(setup.pano, setup.pano_camera, setup.view, setup.pano_from_view));
  }
  CountPixels(state);
}
BENCHMARK(BM_RenderVirtualView)->Unit(benchmark::kMillisecond);

void BM_OpenCvRemap(benchmark::State& state) {
  Setup setup;
  cv::setNumThreads(1);
  const cv::Mat pano(1024, 2048, CV_8UC3, setup.pano.data().data());
  for (auto _ : state) {
    cv::Mat map_x(kViewSize, kViewSize, CV_32F), map_y(kViewSize, kViewSize, CV_32F);
    for (int r = 0; r < kViewSize; ++r) {
      for (int c = 0; c < kViewSize; ++c) {
        const Eigen::Vector2d pixel = *setup.pano_camera.PixelFromRay(
            setup.pano_from_view * setup.view.RayFromPixel({c + 0.5, r + 0.5}));
        map_x.at<float>(r, c) = static_cast<float>(pixel.x() - 0.5);
        map_y.at<float>(r, c) = static_cast<float>(pixel.y() - 0.5);
      }
    }
    cv::Mat image;
    cv::remap(pano, image, map_x, map_y, cv::INTER_LINEAR, cv::BORDER_WRAP);
    benchmark::DoNotOptimize(image.data);
  }
  CountPixels(state);
}
BENCHMARK(BM_OpenCvRemap)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace enfilade
