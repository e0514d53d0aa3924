// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/box_index.h"

#include <gtest/gtest.h>

#include <random>

namespace enfilade {
namespace {

using Eigen::Vector2d;

TEST(BoxIndex, FindsWhatALookAtEveryBoxFinds) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-20, 20), size(0, 1);
  for (const int count : {0, 1, 2, 300}) {
    std::vector<Box2> boxes;
    for (int i = 0; i < count; ++i) {
      const Vector2d low(place(random), place(random));
      // Some as thin as walls, some as long as the storey, some empty.
      const Vector2d extent(random() % 2 * size(random), random() % 8 == 0 ? 30 : size(random));
      boxes.push_back(random() % 16 == 0 ? Box2() : Box2(low, low + extent));
    }
    const BoxIndex index(boxes);
    for (int k = 0; k < 200; ++k) {
      const Vector2d low(1.3 * place(random), 1.3 * place(random));
      const Box2 box(low, low + 5 * Vector2d(size(random), size(random)));
      std::vector<size_t> expected;
      for (size_t i = 0; i < boxes.size(); ++i) {
        if (boxes[i].intersects(box)) expected.push_back(i);
      }
      EXPECT_EQ(index.Touching(box), expected);
    }
  }
}

TEST(BoxIndex, TouchingBoxesAreFound) {
  const BoxIndex index(
      {Box2(Vector2d(0, 0), Vector2d(0, 4)), Box2(Vector2d(1, 0), Vector2d(3, 0))});
  EXPECT_EQ(index.Touching(Box2(Vector2d(0, 4), Vector2d(1, 5))), std::vector<size_t>{0});
  EXPECT_EQ(index.Touching(Box2(Vector2d(-1, -1), Vector2d(1, 0))), (std::vector<size_t>{0, 1}));
}

}  // namespace
}  // namespace enfilade
