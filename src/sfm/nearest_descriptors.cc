// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/nearest_descriptors.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>

#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace enfilade {
namespace {

// Rows of `a` that are worked on together: their words and lanes' keys stay in the second-level
// cache while the panels of `b` pass.
constexpr int kBlockRows = 512;
static_assert(kBlockRows <= kNumTags);

constexpr int RoundUp(int n, int step) { return (n + step - 1) / step * step; }

// Zeros to begin with, aligned for any vector.
template <typename T>
class AlignedArray {
 public:
  explicit AlignedArray(size_t size) : data_(new (kAlignment) T[size]()), size_(size) {}
  [[nodiscard]] T* data() { return data_.get(); }
  [[nodiscard]] T& operator[](size_t i) { return data_[i]; }
  void Fill(T value) { std::fill_n(data_.get(), size_, value); }

 private:
  static constexpr std::align_val_t kAlignment{64};
  struct Free {
    void operator()(T* p) const { ::operator delete[](p, kAlignment); }
  };
  std::unique_ptr<T[], Free> data_;
  size_t size_;
};

int32_t SquaredNorm(const uint8_t* descriptor) {
  int32_t sum = 0;
  for (int i = 0; i < kDescriptorSize; ++i) sum += descriptor[i] * descriptor[i];
  return sum;
}

// Word w of a descriptor as the kernel takes it. The order of values in a word is of no matter.
uint32_t Word(const uint8_t* descriptor, int w, const DescriptorKernel& kernel) {
  if (kernel.words * 2 == kDescriptorSize)
    return descriptor[2 * w] | static_cast<uint32_t>(descriptor[2 * w + 1]) << 16;
  uint32_t word;
  std::memcpy(&word, descriptor + 4 * w, sizeof word);
  return word;
}

// `b` as kernels read it: panels of columns, the last one filled up with columns that no key of
// theirs wins.
struct Panels {
  const DescriptorKernel& kernel;
  int num_columns;  ///< with those filled up
  AlignedArray<uint32_t> words;
  AlignedArray<int32_t> terms, tags, best;

  Panels(const DescriptorSet& b, const DescriptorKernel& k)
      : kernel(k),
        num_columns(RoundUp(b.size(), k.columns)),
        words(static_cast<size_t>(num_columns) * static_cast<size_t>(k.words)),
        terms(static_cast<size_t>(num_columns)),
        tags(static_cast<size_t>(num_columns)),
        best(static_cast<size_t>(num_columns)) {
    tags.Fill(kNoKey);
    for (int i = 0; i < b.size(); ++i) {
      const auto column = static_cast<size_t>(i);
      terms[column] = SquaredNorm(b.row(i)) << kTagBits;
      tags[column] = i / k.lanes % kNumTags;
      uint32_t* const to = WordsOf(i / k.columns * k.columns) + i % k.columns;
      for (int w = 0; w < k.words; ++w) to[w * k.columns] = Word(b.row(i), w, k);
    }
  }
  [[nodiscard]] uint32_t* WordsOf(int first_column) {
    return words.data() + static_cast<size_t>(first_column) * static_cast<size_t>(kernel.words);
  }
  void AddTo(DescriptorTile& tile, int first_column) {
    tile.b_words = WordsOf(first_column);
    tile.b_terms = terms.data() + first_column;
    tile.b_tags = tags.data() + first_column;
    tile.column_best = best.data() + first_column;
  }
};

// A block of rows of `a`, filled up likewise, and what each lane has found for them.
struct RowBlock {
  const DescriptorKernel& kernel;
  int num_rows = 0;  ///< without those filled up
  AlignedArray<uint32_t> words;
  AlignedArray<int32_t> terms, tags, best, second;

  explicit RowBlock(const DescriptorKernel& k) : RowBlock(k, RoundUp(kBlockRows, k.row_step)) {}

  void Read(const DescriptorSet& a, int first_row) {
    num_rows = std::min(kBlockRows, a.size() - first_row);
    tags.Fill(kNoKey);
    for (int r = 0; r < num_rows; ++r) {
      const uint8_t* const descriptor = a.row(first_row + r);
      terms[static_cast<size_t>(r)] = SquaredNorm(descriptor) << kTagBits;
      tags[static_cast<size_t>(r)] = r;
      uint32_t* const to = words.data() + r * kernel.words;
      for (int w = 0; w < kernel.words; ++w) to[w] = Word(descriptor, w, kernel);
    }
  }
  void Forget() {
    best.Fill(kNoKey);
    second.Fill(kNoKey);
  }
  [[nodiscard]] DescriptorTile Tile() {
    DescriptorTile tile = {};
    tile.num_rows = RoundUp(num_rows, kernel.row_step);
    tile.a_words = words.data();
    tile.a_terms = terms.data();
    tile.a_tags = tags.data();
    tile.row_best = best.data();
    tile.row_second = second.data();
    return tile;
  }

 private:
  RowBlock(const DescriptorKernel& k, int capacity)
      : kernel(k),
        words(static_cast<size_t>(capacity * k.words)),
        terms(static_cast<size_t>(capacity)),
        tags(static_cast<size_t>(capacity)),
        best(static_cast<size_t>(capacity * k.lanes)),
        second(static_cast<size_t>(capacity * k.lanes)) {}
};

// The nearest of what the lanes of a row have seen since `first_column`.
NearestDescriptor NearestOfLanes(const int32_t* best, const int32_t* second, int lanes,
                                 int first_column) {
  const auto lane = static_cast<int>(std::min_element(best, best + lanes) - best);
  if (best[lane] == kNoKey) return {};
  int32_t other = second[lane];
  for (int i = 0; i < lanes; ++i) {
    if (i != lane) other = std::min(other, best[i]);
  }
  NearestDescriptor nearest;
  nearest.idx = first_column + (best[lane] & (kNumTags - 1)) * lanes + lane;
  nearest.squared_distance = best[lane] >> kTagBits;
  if (other != kNoKey) nearest.second_squared_distance = other >> kTagBits;
  return nearest;
}

// `next` has higher indices than `nearest`.
void Merge(const NearestDescriptor& next, NearestDescriptor& nearest) {
  if (next.squared_distance < nearest.squared_distance) {
    const int32_t other = std::min(nearest.squared_distance, next.second_squared_distance);
    nearest = next;
    nearest.second_squared_distance = other;
  } else {
    nearest.second_squared_distance =
        std::min(nearest.second_squared_distance, next.squared_distance);
  }
}

// All panels against a block of rows, as many at a time as there are tags for their vectors.
void ScanPanels(RowBlock& block, Panels& panels, NearestDescriptor* in_b) {
  const DescriptorKernel& kernel = panels.kernel;
  const int sweep_columns = kNumTags * kernel.lanes;
  DescriptorTile tile = block.Tile();
  for (int first = 0; first < panels.num_columns; first += sweep_columns) {
    block.Forget();
    const int end = std::min(first + sweep_columns, panels.num_columns);
    for (int column = first; column < end; column += kernel.columns) {
      panels.AddTo(tile, column);
      kernel.scan(tile);
    }
    for (int r = 0; r < block.num_rows; ++r) {
      const int lane = r * kernel.lanes;
      Merge(
          NearestOfLanes(block.best.data() + lane, block.second.data() + lane, kernel.lanes, first),
          in_b[r]);
    }
  }
}

#if defined(__x86_64__)
// Compilers older than such processors have no name for it.
bool HasAvxVnni() {
  unsigned eax = 0, ebx = 0, ecx = 0, edx = 0;
  return __builtin_cpu_supports("avx2") && __get_cpuid_count(7, 1, &eax, &ebx, &ecx, &edx) != 0 &&
         (eax >> 4 & 1) != 0;
}
#endif

}  // namespace

std::vector<const DescriptorKernel*> UsableDescriptorKernels() {
  std::vector<const DescriptorKernel*> kernels;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vnni"))
    kernels.push_back(&Avx512DescriptorKernel());
  if (HasAvxVnni()) kernels.push_back(&AvxVnniDescriptorKernel());
  if (__builtin_cpu_supports("avx2")) kernels.push_back(&Avx2DescriptorKernel());
  kernels.push_back(&Sse2DescriptorKernel());
#endif
  kernels.push_back(&PortableDescriptorKernel());
  return kernels;
}

NearestDescriptors FindNearestDescriptors(const DescriptorSet& a, const DescriptorSet& b,
                                          const DescriptorKernel& kernel) {
  NearestDescriptors nearest;
  nearest.in_b.resize(static_cast<size_t>(a.size()));
  nearest.idx_in_a.assign(static_cast<size_t>(b.size()), -1);
  std::vector<int32_t> distances(nearest.idx_in_a.size(), NearestDescriptor::kFar);
  Panels panels(b, kernel);
  RowBlock block(kernel);
  for (int first_row = 0; first_row < a.size(); first_row += kBlockRows) {
    block.Read(a, first_row);
    panels.best.Fill(kNoKey);
    ScanPanels(block, panels, nearest.in_b.data() + first_row);
    for (size_t i = 0; i < distances.size(); ++i) {
      const int32_t key = panels.best[i];
      if (key >> kTagBits >= distances[i]) continue;
      distances[i] = key >> kTagBits;
      nearest.idx_in_a[i] = first_row + (key & (kNumTags - 1));
    }
  }
  return nearest;
}

}  // namespace enfilade
