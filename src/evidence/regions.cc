// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "regions.h"

#include <algorithm>
#include <array>
#include <utility>

namespace enfilade {
namespace {

template <typename T>
bool IsInside(const Image<T>& image, int row, int col) {
  return row >= 0 && col >= 0 && row < image.rows() && col < image.cols();
}

}  // namespace

Components LabelComponents(const ImageU8& mask, Connectivity connectivity) {
  const size_t num_neighbours = connectivity == Connectivity::kFour ? 4 : 8;
  Components components{ImageI(mask.rows(), mask.cols()), {0}};
  ImageI& label = components.label;
  std::vector<std::pair<int, int>> stack;
  for (int r = 0; r < mask.rows(); ++r) {
    for (int c = 0; c < mask.cols(); ++c) {
      if (mask(r, c) == 0 || label(r, c) != 0) continue;
      const int id = static_cast<int>(components.num_cells.size());
      components.num_cells.push_back(0);
      label(r, c) = id;
      stack.emplace_back(r, c);
      while (!stack.empty()) {
        const auto [row, col] = stack.back();
        stack.pop_back();
        ++components.num_cells.back();
        for (size_t k = 0; k < num_neighbours; ++k) {
          const int y = row + kNeighbours[k].first, x = col + kNeighbours[k].second;
          if (!IsInside(mask, y, x) || mask(y, x) == 0 || label(y, x) != 0) continue;
          label(y, x) = id;
          stack.emplace_back(y, x);
        }
      }
    }
  }
  return components;
}

ImageI GrowLabels(const ImageI& seeds, const ImageU8& mask) {
  ImageI label(seeds.rows(), seeds.cols());
  std::vector<std::pair<int, int>> queue;
  for (int r = 0; r < seeds.rows(); ++r) {
    for (int c = 0; c < seeds.cols(); ++c) {
      if (seeds(r, c) == 0 || mask(r, c) == 0) continue;
      label(r, c) = seeds(r, c);
      queue.emplace_back(r, c);
    }
  }
  for (size_t next = 0; next < queue.size(); ++next) {
    const auto [row, col] = queue[next];
    for (size_t k = 0; k < 4; ++k) {
      const int y = row + kNeighbours[k].first, x = col + kNeighbours[k].second;
      if (!IsInside(mask, y, x) || mask(y, x) == 0 || label(y, x) != 0) continue;
      label(y, x) = label(row, col);
      queue.emplace_back(y, x);
    }
  }
  return label;
}

}  // namespace enfilade
