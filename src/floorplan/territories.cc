// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/territories.h"

#include <algorithm>
#include <utility>

namespace enfilade {

std::vector<ImageU8> SeparateCores(const EvidenceGrids& evidence) {
  std::vector<ImageU8> cores;
  for (int k = 1; k <= evidence.num_cores; ++k) {
    ImageU8 cells(evidence.frame.rows, evidence.frame.cols);
    for (size_t i = 0; i < cells.data().size(); ++i) cells.data()[i] = evidence.core.data()[i] == k;
    const std::vector<CellSet> sets = ConnectedCells(cells);
    if (sets.empty()) continue;
    const CellSet& largest =
        *std::max_element(sets.begin(), sets.end(),
                          [](const CellSet& a, const CellSet& b) { return a.size() < b.size(); });
    std::fill(cells.data().begin(), cells.data().end(), uint8_t{0});
    for (const int cell : largest) cells.data()[static_cast<size_t>(cell)] = 1;
    cores.push_back(std::move(cells));
  }
  return cores;
}

ImageI AssignTerritories(const ImageF& solid, const std::vector<ImageU8>& cores) {
  ImageF cost(solid.rows(), solid.cols());
  ImageI source(solid.rows(), solid.cols(), 1, -1);
  for (size_t i = 0; i < cost.data().size(); ++i) {
    cost.data()[i] = 1 + 30 * solid.data()[i];
    for (size_t k = 0; k < cores.size(); ++k) {
      if (cores[k].data()[i] != 0) source.data()[i] = static_cast<int>(k);
    }
  }
  return FindCellWays(cost, source).source;
}

ImageU8 ForeignCells(const ImageI& territories, int own) {
  ImageU8 foreign(territories.rows(), territories.cols());
  for (size_t i = 0; i < foreign.data().size(); ++i)
    foreign.data()[i] = territories.data()[i] != own;
  return foreign;
}

}  // namespace enfilade
