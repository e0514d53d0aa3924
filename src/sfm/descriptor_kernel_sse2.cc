// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/scan_tile.h"

#if defined(__x86_64__)
#include <immintrin.h>

namespace enfilade {
namespace {

struct Sse2 {
  static constexpr int kWords = 64, kLanes = 4, kRows = 2, kVectors = 4;

  template <typename Vector>
  static Vector MultiplyAdd(Vector sum, Vector a, Vector b) {
    return sum + Vector(_mm_madd_epi16(__m128i(a), __m128i(b)));
  }
};

}  // namespace

const DescriptorKernel& Sse2DescriptorKernel() {
  static constexpr DescriptorKernel kKernel = KernelOf<Sse2>("SSE2");
  return kKernel;
}

}  // namespace enfilade
#endif
