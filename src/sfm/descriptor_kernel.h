// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace enfilade {

// The innermost loop of matching, one version for each instruction set. A version is compiled for
// its instruction set as a whole, so what it includes may define no inline function: the linker
// might keep the copy that only some machines can run.
//
// Keys. A squared distance is below 2^21 (127² · 128 = 2064512), so one non-negative 32-bit number
// holds it and, in the 10 bits below, the tag of the descriptor at that distance. The least key is
// the nearest descriptor, and of equally near ones that of the lowest tag.

inline constexpr int kTagBits = 10;
inline constexpr int kNumTags = 1 << kTagBits;
/// Key of nothing, larger than any other; as a tag it makes such a key.
inline constexpr int32_t kNoKey = 0x7FFFFFFF;

/// What a kernel reads and updates: rows of `a` against one panel of columns of `b`. A descriptor
/// is a row of 32-bit words that hold several values each.
struct DescriptorTile {
  int num_rows;             ///< multiple of the kernel's row step
  const uint32_t* a_words;  ///< num_rows × words, row by row
  const int32_t* a_terms;   ///< num_rows: squared norms · 2^kTagBits
  const int32_t* a_tags;    ///< num_rows: tag of the row, kNoKey beyond the last descriptor
  const uint32_t* b_words;  ///< words × columns, word by word
  const int32_t* b_terms;   ///< columns
  const int32_t* b_tags;    ///< columns: tag of the vector that the column belongs to, or kNoKey
  int32_t* row_best;        ///< num_rows × lanes: least key of the columns seen by each lane
  int32_t* row_second;      ///< num_rows × lanes: second least
  int32_t* column_best;     ///< columns: least key of the rows
};

/// A way to work through a tile. Arrays that are indexed by lane or column are aligned to 64 bytes.
struct DescriptorKernel {
  const char* name;
  int words;    ///< of a descriptor: 32 with 4 values of 8 bits each, or 64 with 2 of 16
  int lanes;    ///< 32-bit numbers in a vector
  int columns;  ///< in a panel, a multiple of lanes; lane = column mod lanes
  int row_step;
  void (*scan)(const DescriptorTile& tile);
};

/// The kernels; a machine may call those whose instructions it has.
[[nodiscard]] const DescriptorKernel& PortableDescriptorKernel();
#if defined(__x86_64__)
[[nodiscard]] const DescriptorKernel& Sse2DescriptorKernel();
[[nodiscard]] const DescriptorKernel& Avx2DescriptorKernel();
[[nodiscard]] const DescriptorKernel& AvxVnniDescriptorKernel();
[[nodiscard]] const DescriptorKernel& Avx512DescriptorKernel();
#endif

}  // namespace enfilade
