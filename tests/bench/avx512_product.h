// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace enfilade {

/// True where MultiplyAvx512 was compiled for AVX-512 and the machine has it.
[[nodiscard]] bool CanMultiplyAvx512();

/// Eigen's product a · bᵀ, compiled for AVX-512 and FMA. `a` and `b` are n × depth, row by row,
/// `product` is n × n.
void MultiplyAvx512(const float* a, const float* b, int n, int depth, float* product);

}  // namespace enfilade
