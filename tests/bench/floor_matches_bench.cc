// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0

// Floors laid on each other: all pairs of eight panoramas, beside OpenCV's
// phase correlation of as large pictures at four turns, which knows no masks and tells one peak.
// One thread.
#include "src/sfm/floor_places.h"

#include <benchmark/benchmark.h>

#include <opencv2/imgproc.hpp>
#include <vector>

#include "tests/sfm/floor_panorama.h"

namespace enfilade {
namespace {

constexpr int kNumPanoramas = 8;

std::vector<FloorPicture> MakeFloors() {
  std::vector<FloorPicture> floors;
  for (int i = 0; i < kNumPanoramas; ++i) {
    floors.push_back(FloorPano{{0.3 * i, 0.2 * i}, 0.5 * i}.Look(RandomFloor(1)));
  }
  return floors;
}

std::vector<ViewPair> AllPairs() {
  std::vector<ViewPair> pairs;
  for (int a = 0; a < kNumPanoramas; ++a) {
    for (int b = a + 1; b < kNumPanoramas; ++b) pairs.push_back({a, b});
  }
  return pairs;
}

void BM_PlaceFloors(benchmark::State& state) {
  const std::vector<FloorPicture> floors = MakeFloors();
  const std::vector<ViewPair> pairs = AllPairs();
  RunContext context(1);
  for (auto _ : state) benchmark::DoNotOptimize(PlaceFloors(floors, pairs, context));
  state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(pairs.size()));
}
BENCHMARK(BM_PlaceFloors)->Unit(benchmark::kMillisecond);

void BM_PhaseCorrelate(benchmark::State& state) {
  cv::setNumThreads(1);
  std::vector<cv::Mat> pictures;
  for (const FloorPicture& floor : MakeFloors()) {
    const cv::Mat contrast(FloorPicture::kSide, FloorPicture::kSide, CV_8S,
                           const_cast<int8_t*>(floor.contrast.data().data()));
    cv::Mat values, padded;
    contrast.convertTo(values, CV_32F);
    cv::copyMakeBorder(values, padded, 0, 720 - FloorPicture::kSide, 0, 720 - FloorPicture::kSide,
                       cv::BORDER_CONSTANT);
    pictures.push_back(padded);
  }
  const std::vector<ViewPair> pairs = AllPairs();
  for (auto _ : state) {
    for (const ViewPair& pair : pairs) {
      cv::Mat turned = pictures[static_cast<size_t>(pair.b_idx)];
      for (int turn = 0; turn < 4; ++turn) {
        benchmark::DoNotOptimize(
            cv::phaseCorrelate(pictures[static_cast<size_t>(pair.a_idx)], turned));
        cv::rotate(turned, turned, cv::ROTATE_90_CLOCKWISE);
      }
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(pairs.size()));
}
BENCHMARK(BM_PhaseCorrelate)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace enfilade
