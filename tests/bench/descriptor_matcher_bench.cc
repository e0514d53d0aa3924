// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0

// The matcher beside a plain matrix product of the same size (n × 128 by 128 × n, the least that
// any exhaustive search in floating point does) and beside OpenCV's exhaustive matcher with the
// same tests. One thread; pairs/s counts pairs of descriptors.
#include "enfilade/sfm/descriptor_matcher.h"

#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <random>
#include <vector>

#include "src/sfm/nearest_descriptors.h"
#include "tests/bench/avx512_product.h"
#include "tests/sfm/random_descriptors.h"

namespace enfilade {
namespace {

using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Pair {
  DescriptorSet a, b;

  explicit Pair(int size) : a(RandomValues(size, 40, 1)), b(RandomValues(size, 40, 2)) {
    // Half of them find a partner.
    std::copy_n(a.values.begin(), a.values.size() / 2, b.values.begin());
  }
};

RowMajor FloatsOf(const DescriptorSet& set) {
  return Eigen::Map<const Eigen::Matrix<uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
             set.values.data(), set.size(), kDescriptorSize)
      .cast<float>();
}

cv::Mat MatOf(const RowMajor& rows) {
  return cv::Mat(static_cast<int>(rows.rows()), static_cast<int>(rows.cols()), CV_32F,
                 const_cast<float*>(rows.data()));
}

void CountPairs(benchmark::State& state) {
  const auto n = static_cast<double>(state.range(0));
  state.counters["pairs/s"] =
      benchmark::Counter(n * n, benchmark::Counter::kIsIterationInvariantRate);
}

void BM_MatchDescriptors(benchmark::State& state) {
  const Pair pair(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(MatchDescriptors(pair.a, pair.b, {}));
  CountPairs(state);
}
BENCHMARK(BM_MatchDescriptors)->Arg(4000)->Arg(10000)->Unit(benchmark::kMillisecond);

// Without the choice of the kernel: kernel 0 is the fastest that the machine can run.
void BM_Kernel(benchmark::State& state) {
  const Pair pair(static_cast<int>(state.range(0)));
  const auto kernels = UsableDescriptorKernels();
  const auto k = static_cast<size_t>(state.range(1));
  if (k >= kernels.size()) {
    state.SkipWithError("no such kernel on this machine");
    return;
  }
  for (auto _ : state)
    benchmark::DoNotOptimize(FindNearestDescriptors(pair.a, pair.b, *kernels[k]));
  CountPairs(state);
  state.SetLabel(kernels[k]->name);
}
BENCHMARK(BM_Kernel)->ArgsProduct({{4000}, {0, 1, 2, 3, 4}})->Unit(benchmark::kMillisecond);

void BM_EigenProduct(benchmark::State& state) {
  const Pair pair(static_cast<int>(state.range(0)));
  const RowMajor a = FloatsOf(pair.a), b = FloatsOf(pair.b);
  RowMajor product(a.rows(), b.rows());
  for (auto _ : state) {
    product.noalias() = a * b.transpose();
    benchmark::DoNotOptimize(product.data());
  }
  CountPairs(state);
}
BENCHMARK(BM_EigenProduct)->Arg(4000)->Arg(10000)->Unit(benchmark::kMillisecond);

void BM_EigenProductAvx512(benchmark::State& state) {
  if (!CanMultiplyAvx512()) {
    state.SkipWithError("no AVX-512 on this machine");
    return;
  }
  const Pair pair(static_cast<int>(state.range(0)));
  const RowMajor a = FloatsOf(pair.a), b = FloatsOf(pair.b);
  RowMajor product(a.rows(), b.rows());
  for (auto _ : state) {
    MultiplyAvx512(a.data(), b.data(), static_cast<int>(a.rows()), static_cast<int>(a.cols()),
                   product.data());
    benchmark::DoNotOptimize(product.data());
  }
  CountPairs(state);
}
BENCHMARK(BM_EigenProductAvx512)->Arg(4000)->Arg(10000)->Unit(benchmark::kMillisecond);

void BM_CvGemm(benchmark::State& state) {
  cv::setNumThreads(1);
  const Pair pair(static_cast<int>(state.range(0)));
  const RowMajor a = FloatsOf(pair.a), b = FloatsOf(pair.b);
  cv::Mat product;
  for (auto _ : state) {
    cv::gemm(MatOf(a), MatOf(b), 1, cv::noArray(), 0, product, cv::GEMM_2_T);
    benchmark::DoNotOptimize(product.data);
  }
  CountPairs(state);
}
BENCHMARK(BM_CvGemm)->Arg(4000)->Unit(benchmark::kMillisecond);

// The two best of each row, and the best of each column.
void BM_CvBfMatcher(benchmark::State& state) {
  cv::setNumThreads(1);
  const Pair pair(static_cast<int>(state.range(0)));
  const RowMajor a = FloatsOf(pair.a), b = FloatsOf(pair.b);
  const cv::BFMatcher matcher(cv::NORM_L2);
  for (auto _ : state) {
    std::vector<std::vector<cv::DMatch>> there;
    std::vector<cv::DMatch> back;
    matcher.knnMatch(MatOf(a), MatOf(b), there, 2);
    matcher.match(MatOf(b), MatOf(a), back);
    benchmark::DoNotOptimize(there.data());
    benchmark::DoNotOptimize(back.data());
  }
  CountPairs(state);
}
BENCHMARK(BM_CvBfMatcher)->Arg(4000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace enfilade
