// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
// Superpixels on the sphere beside OpenCV's SLIC and SEEDS on the flat picture, all with about as
// many superpixels: time, and how many of the true edges between surfaces of a rendered furnished
// home are found (boundary recall within two pixels, every pixel by its solid angle).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/ximgproc/seeds.hpp>
#include <opencv2/ximgproc/slic.hpp>
#include <utility>

#include "enfilade/geometry/angles.h"
#include "enfilade/image/superpixels.h"
#include "enfilade/synthetic/home.h"
#include "enfilade/synthetic/render.h"

namespace enfilade {
namespace {

constexpr int kReach_px = 2;

const RenderedPanorama& Rendered() {
  static const RenderedPanorama panorama = [] {
    HomeOptions options;
    options.preset = HomePreset::kFurnished;
    RunContext context;
    return HomeRenderer(MakeHome(options), RenderOptions(), context)
        .Render(0, {2048, 1024}, context);
  }();
  return panorama;
}

cv::Mat Lab() {
  const ImageU8& rgb = Rendered().rgb;
  cv::Mat lab;
  cv::cvtColor(cv::Mat(rgb.rows(), rgb.cols(), CV_8UC3, const_cast<uint8_t*>(rgb.data().data())),
               lab, cv::COLOR_RGB2Lab);
  return lab;
}

// Edges between pixels of unlike values; `value(row, col)`.
template <typename Value>
ImageU8 EdgesOf(int rows, int cols, const Value& value) {
  ImageU8 edges(rows, cols);
  for (int r = 0; r + 1 < rows; ++r) {
    for (int c = 0; c < cols; ++c)
      edges(r, c) = value(r, c) != value(r, (c + 1) % cols) || value(r, c) != value(r + 1, c);
  }
  return edges;
}

double BoundaryRecall(const ImageU8& found) {
  const RenderedPanorama& truth = Rendered();
  const int rows = found.rows(), cols = found.cols();
  const ImageU8 edges = EdgesOf(rows, cols, [&](int r, int c) {
    return std::pair(static_cast<int>(truth.label(r, c)), static_cast<int>(truth.wall_id(r, c)));
  });
  double hits = 0, total = 0;
  for (int r = 0; r < rows; ++r) {
    const double weight = std::cos(kPi * (0.5 - (r + 0.5) / rows));
    for (int c = 0; c < cols; ++c) {
      if (edges(r, c) == 0) continue;
      bool is_near = false;
      for (int i = std::max(0, r - kReach_px); i <= std::min(rows - 1, r + kReach_px); ++i) {
        for (int j = -kReach_px; j <= kReach_px; ++j)
          is_near = is_near || found(i, (c + j + cols) % cols) != 0;
      }
      total += weight;
      hits += is_near ? weight : 0;
    }
  }
  return hits / total;
}

void Report(benchmark::State& state, int count, const ImageU8& edges) {
  const double pixels = static_cast<double>(edges.rows()) * edges.cols();
  state.counters["superpixels"] = count;
  state.counters["recall"] = BoundaryRecall(edges);
  state.counters["edge_share"] =
      static_cast<double>(std::count(edges.data().begin(), edges.data().end(), 1)) / pixels;
  state.counters["pixels_per_s"] = benchmark::Counter(
      pixels * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

ImageU8 EdgesOf(const cv::Mat& label) {
  return EdgesOf(label.rows, label.cols, [&](int r, int c) { return label.at<int>(r, c); });
}

void Ours(benchmark::State& state) {
  SuperpixelOptions options;
  options.count = static_cast<int>(state.range(0));
  const ImageU8& rgb = Rendered().rgb;
  Superpixels found;
  for (auto _ : state) found = MakeSuperpixels(rgb, options);
  Report(state, static_cast<int>(found.pixels.size()),
         EdgesOf(rgb.rows(), rgb.cols(), [&](int r, int c) { return found.label(r, c); }));
}

// The same steps: colours, the same number of rounds, small pieces joined.
void OpenCvSlic(benchmark::State& state) {
  const auto size =
      static_cast<int>(std::lround(std::sqrt(2048.0 * 1024 / static_cast<double>(state.range(0)))));
  cv::Mat label;
  int count = 0;
  for (auto _ : state) {
    const auto slic = cv::ximgproc::createSuperpixelSLIC(Lab(), cv::ximgproc::SLIC, size, 12);
    slic->iterate(SuperpixelOptions().num_iterations);
    slic->enforceLabelConnectivity(25);
    slic->getLabels(label);
    count = slic->getNumberOfSuperpixels();
  }
  Report(state, count, EdgesOf(label));
}

void OpenCvSeeds(benchmark::State& state) {
  cv::Mat label;
  int count = 0;
  for (auto _ : state) {
    const auto seeds =
        cv::ximgproc::createSuperpixelSEEDS(2048, 1024, 3, static_cast<int>(state.range(0)), 4);
    seeds->iterate(Lab(), SuperpixelOptions().num_iterations);
    seeds->getLabels(label);
    count = seeds->getNumberOfSuperpixels();
  }
  Report(state, count, EdgesOf(label));
}

BENCHMARK(Ours)->Arg(1000)->Arg(3000)->Unit(benchmark::kMillisecond);
BENCHMARK(OpenCvSlic)->Arg(1000)->Arg(3000)->Unit(benchmark::kMillisecond);
BENCHMARK(OpenCvSeeds)->Arg(1000)->Arg(3000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace enfilade
