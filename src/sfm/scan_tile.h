// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "src/sfm/descriptor_kernel.h"

namespace enfilade {

/// The loop of all kernels. `Isa` names the number of lanes, the shape of the block of dot products
/// that stays in registers (kRows × kVectors), the words of a descriptor and
/// MultiplyAdd(sum, a, b), which multiplies the values within each word and adds them to the sum.
/// `Isa` has to stand in an unnamed namespace, so that each instruction set has a copy of its own.
template <typename Isa>
class TileScan {
 public:
  static constexpr int kLanes = Isa::kLanes, kColumns = Isa::kVectors * kLanes;

  static void Run(const DescriptorTile& tile) {
    for (int row = 0; row < tile.num_rows; row += kRows) {
      Vector dots[kRows][kVectors];
      Multiply(tile.a_words + row * kWords, tile.b_words, dots);
      Update(tile, row, dots);
    }
  }

 private:
  // The compilers' own vectors: sums of them stay in registers, while GCC 12 copies each __m512i to
  // memory at every step.
  typedef int32_t Vector __attribute__((vector_size(4 * kLanes)));
  typedef uint32_t Wrapping __attribute__((vector_size(4 * kLanes)));
  static constexpr int kRows = Isa::kRows, kVectors = Isa::kVectors, kWords = Isa::kWords;

  static Vector Load(const void* from) {
    Vector vector;
    __builtin_memcpy(&vector, __builtin_assume_aligned(from, sizeof vector), sizeof vector);
    return vector;
  }
  static void Store(const Vector& vector, int32_t* to) {
    __builtin_memcpy(__builtin_assume_aligned(to, sizeof vector), &vector, sizeof vector);
  }
  static Vector Broadcast(int32_t number) { return Vector{} + number; }
  static Vector Min(const Vector& a, const Vector& b) { return a < b ? a : b; }
  static Vector Max(const Vector& a, const Vector& b) { return a < b ? b : a; }

  static void Multiply(const uint32_t* a_words, const uint32_t* b_words,
                       Vector (&dots)[kRows][kVectors]) {
#pragma GCC unroll 8
    for (int r = 0; r < kRows; ++r) {
#pragma GCC unroll 8
      for (int v = 0; v < kVectors; ++v) dots[r][v] = Vector{};
    }
    for (int w = 0; w < kWords; ++w) {
      Vector b[kVectors];
#pragma GCC unroll 8
      for (int v = 0; v < kVectors; ++v) b[v] = Load(b_words + w * kColumns + v * kLanes);
#pragma GCC unroll 8
      for (int r = 0; r < kRows; ++r) {
        const Vector a = Broadcast(static_cast<int32_t>(a_words[r * kWords + w]));
#pragma GCC unroll 8
        for (int v = 0; v < kVectors; ++v) dots[r][v] = Isa::MultiplyAdd(dots[r][v], a, b[v]);
      }
    }
  }

  // |a − b|² = |a|² + |b|² − 2ab, all times 2^kTagBits; it fits although its parts may overflow.
  static void Update(const DescriptorTile& tile, int row, const Vector (&dots)[kRows][kVectors]) {
    Vector column_best[kVectors];
#pragma GCC unroll 8
    for (int v = 0; v < kVectors; ++v) column_best[v] = Load(tile.column_best + v * kLanes);
#pragma GCC unroll 8
    for (int r = 0; r < kRows; ++r) {
      const Wrapping a_term = reinterpret_cast<Wrapping>(Broadcast(tile.a_terms[row + r]));
      const Vector a_tag = Broadcast(tile.a_tags[row + r]);
      int32_t* const row_best = tile.row_best + (row + r) * kLanes;
      int32_t* const row_second = tile.row_second + (row + r) * kLanes;
      Vector best = Load(row_best), second = Load(row_second);
#pragma GCC unroll 8
      for (int v = 0; v < kVectors; ++v) {
        const Wrapping b_term = reinterpret_cast<Wrapping>(Load(tile.b_terms + v * kLanes));
        const Wrapping product = reinterpret_cast<Wrapping>(dots[r][v]) << (kTagBits + 1);
        const Vector distance = reinterpret_cast<Vector>(a_term - product + b_term);
        const Vector key = distance | Load(tile.b_tags + v * kLanes);
        second = Min(second, Max(best, key));
        best = Min(best, key);
        column_best[v] = Min(column_best[v], distance | a_tag);
      }
      Store(best, row_best);
      Store(second, row_second);
    }
#pragma GCC unroll 8
    for (int v = 0; v < kVectors; ++v) Store(column_best[v], tile.column_best + v * kLanes);
  }
};

template <typename Isa>
constexpr DescriptorKernel KernelOf(const char* name) {
  return {name, Isa::kWords, Isa::kLanes, TileScan<Isa>::kColumns, Isa::kRows, TileScan<Isa>::Run};
}

}  // namespace enfilade
