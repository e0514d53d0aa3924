// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/nearest_descriptors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/sfm/random_descriptors.h"

namespace enfilade {
namespace {

int32_t SquaredDistance(const uint8_t* a, const uint8_t* b) {
  int32_t sum = 0;
  for (int i = 0; i < kDescriptorSize; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

// The slow twin of one way.
NearestDescriptor NearestOf(const uint8_t* descriptor, const DescriptorSet& others) {
  NearestDescriptor nearest;
  for (int i = 0; i < others.size(); ++i) {
    const int32_t distance = SquaredDistance(descriptor, others.row(i));
    if (distance < nearest.squared_distance) {
      nearest = {i, distance, nearest.squared_distance};
    } else {
      nearest.second_squared_distance = std::min(nearest.second_squared_distance, distance);
    }
  }
  return nearest;
}

void ExpectTrueNeighbours(const DescriptorSet& a, const DescriptorSet& b,
                          const DescriptorKernel& kernel) {
  const NearestDescriptors nearest = FindNearestDescriptors(a, b, kernel);
  ASSERT_EQ(nearest.in_b.size(), static_cast<size_t>(a.size()));
  ASSERT_EQ(nearest.idx_in_a.size(), static_cast<size_t>(b.size()));
  for (int i = 0; i < a.size(); ++i)
    ASSERT_EQ(nearest.in_b[static_cast<size_t>(i)], NearestOf(a.row(i), b)) << "row " << i;
  for (int i = 0; i < b.size(); ++i)
    ASSERT_EQ(nearest.idx_in_a[static_cast<size_t>(i)], NearestOf(b.row(i), a).idx) << "col " << i;
}

class EachKernel : public testing::TestWithParam<const DescriptorKernel*> {};

// Around one and two vectors, panels, row steps and blocks of every kernel.
TEST_P(EachKernel, AgreesWithTheTwinForSizesRoundEveryStep) {
  for (const int rows : {1, 2, 3, 5, 6, 7, 511, 512, 513}) {
    for (const int columns : {1, 3, 4, 15, 16, 17, 63, 64, 65, 129}) {
      SCOPED_TRACE(std::to_string(rows) + " x " + std::to_string(columns));
      const auto seed = static_cast<uint32_t>(1000 * rows + columns);
      ASSERT_NO_FATAL_FAILURE(ExpectTrueNeighbours(
          RandomValues(rows, 127, seed), RandomValues(columns, 127, seed + 1), *GetParam()));
    }
  }
}

TEST_P(EachKernel, LowestIndexWinsWhereManyAreEquallyNear) {
  DescriptorSet a = RandomValues(700, 0, 1), b = RandomValues(900, 0, 2);
  // Nothing but 0 and 1 in the first few places: hundreds of equal descriptors each way.
  for (int i = 0; i < a.size(); ++i) a.values[static_cast<size_t>(i) * kDescriptorSize + i % 5] = 1;
  for (int i = 0; i < b.size(); ++i) b.values[static_cast<size_t>(i) * kDescriptorSize + i % 7] = 1;
  ASSERT_NO_FATAL_FAILURE(ExpectTrueNeighbours(a, b, *GetParam()));
}

// The sums reach their bounds: 0 and 2064512.
TEST_P(EachKernel, AgreesWithTheTwinForExtremeValues) {
  DescriptorSet black = RandomValues(70, 0, 1), white = black;
  std::fill(white.values.begin(), white.values.end(), kMaxDescriptorValue);
  DescriptorSet either = black;
  std::fill(either.values.begin() + 30 * kDescriptorSize, either.values.end(), kMaxDescriptorValue);
  for (const DescriptorSet* a : {&black, &white, &either}) {
    for (const DescriptorSet* b : {&black, &white, &either})
      ASSERT_NO_FATAL_FAILURE(ExpectTrueNeighbours(*a, *b, *GetParam()));
  }
}

// More columns than there are tags for: 4 lanes take a second sweep after 4096, 16 after 16384.
TEST_P(EachKernel, AgreesWithTheTwinOverSeveralSweeps) {
  const DescriptorSet b = RandomValues(2 * kNumTags * GetParam()->lanes + 77, 3, 5);
  DescriptorSet a = RandomValues(9, 3, 6);
  // Copies of the first and last, and of one in the second sweep.
  std::copy_n(b.row(0), kDescriptorSize, a.values.begin());
  std::copy_n(b.row(b.size() - 1), kDescriptorSize, a.values.begin() + kDescriptorSize);
  std::copy_n(b.row(b.size() * 2 / 3), kDescriptorSize, a.values.begin() + 2 * kDescriptorSize);
  ASSERT_NO_FATAL_FAILURE(ExpectTrueNeighbours(a, b, *GetParam()));
}

TEST_P(EachKernel, EmptySetsHaveNoNeighbours) {
  const DescriptorSet some = RandomValues(3, 127, 1), none;
  EXPECT_THAT(FindNearestDescriptors(some, none, *GetParam()).in_b,
              testing::Each(NearestDescriptor()));
  EXPECT_THAT(FindNearestDescriptors(none, some, *GetParam()).idx_in_a, testing::Each(-1));
  EXPECT_TRUE(FindNearestDescriptors(none, none, *GetParam()).in_b.empty());
}

INSTANTIATE_TEST_SUITE_P(Descriptors, EachKernel, testing::ValuesIn(UsableDescriptorKernels()),
                         [](const auto& param) {
                           std::string name = param.param->name;
                           std::erase_if(name, [](char c) { return c == '-' || c == ' '; });
                           return name;
                         });

}  // namespace
}  // namespace enfilade
