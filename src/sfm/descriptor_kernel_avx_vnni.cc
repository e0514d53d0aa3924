// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/scan_tile.h"

#if defined(__x86_64__)
#include <immintrin.h>

namespace enfilade {
namespace {

struct AvxVnni {
  static constexpr int kWords = 32, kLanes = 8, kRows = 3, kVectors = 4;

  template <typename Vector>
  static Vector MultiplyAdd(Vector sum, Vector a, Vector b) {
    return Vector(_mm256_dpbusd_avx_epi32(__m256i(sum), __m256i(a), __m256i(b)));
  }
};

}  // namespace

const DescriptorKernel& AvxVnniDescriptorKernel() {
  static constexpr DescriptorKernel kKernel = KernelOf<AvxVnni>("AVX-VNNI");
  return kKernel;
}

}  // namespace enfilade
#endif
