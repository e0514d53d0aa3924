// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/avx512_product.h"

// The linker would keep one copy of Eigen's functions for the whole program: this one is for this
// file alone.
#define Eigen EigenAvx512
#include <Eigen/Core>

namespace enfilade {

bool CanMultiplyAvx512() {
#if defined(__AVX512F__)
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
#else
  return false;
#endif
}

void MultiplyAvx512(const float* a, const float* b, int n, int depth, float* product) {
  using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using Rows = Eigen::Map<const RowMajor>;
  Eigen::Map<RowMajor>(product, n, n).noalias() = Rows(a, n, depth) * Rows(b, n, depth).transpose();
}

}  // namespace enfilade
