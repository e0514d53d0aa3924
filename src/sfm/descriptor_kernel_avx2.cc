// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/scan_tile.h"

#if defined(__x86_64__)
#include <immintrin.h>

namespace enfilade {
namespace {

struct Avx2 {
  static constexpr int kWords = 32, kLanes = 8, kRows = 3, kVectors = 4;

  // Two products of 7 bits fit in the 16 bits of the first step.
  template <typename Vector>
  static Vector MultiplyAdd(Vector sum, Vector a, Vector b) {
    const __m256i pairs = _mm256_maddubs_epi16(__m256i(a), __m256i(b));
    return sum + Vector(_mm256_madd_epi16(pairs, _mm256_set1_epi16(1)));
  }
};

}  // namespace

const DescriptorKernel& Avx2DescriptorKernel() {
  static constexpr DescriptorKernel kKernel = KernelOf<Avx2>("AVX2");
  return kKernel;
}

}  // namespace enfilade
#endif
