// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/scan_tile.h"

#if defined(__x86_64__)
#include <immintrin.h>

namespace enfilade {
namespace {

struct Avx512 {
  static constexpr int kWords = 32, kLanes = 16, kRows = 6, kVectors = 4;

  template <typename Vector>
  static Vector MultiplyAdd(Vector sum, Vector a, Vector b) {
    return Vector(_mm512_dpbusd_epi32(__m512i(sum), __m512i(a), __m512i(b)));
  }
};

}  // namespace

const DescriptorKernel& Avx512DescriptorKernel() {
  static constexpr DescriptorKernel kKernel = KernelOf<Avx512>("AVX-512 VNNI");
  return kKernel;
}

}  // namespace enfilade
#endif
