// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/territories.h"

#include <utility>

namespace enfilade {

CoreMap MapCores(const EvidenceGrids& evidence) {
  const int rows = evidence.frame.rows, cols = evidence.frame.cols;
  std::vector<CellSet> largest(static_cast<size_t>(evidence.num_cores) + 1);  // of each label
  for (CellSet& set : ConnectedCells(evidence.core)) {
    const size_t label = evidence.core.data()[static_cast<size_t>(set.front())];
    if (label < largest.size() && set.size() > largest[label].size())
      largest[label] = std::move(set);
  }
  CoreMap map{ImageI(rows, cols, 1, -1), {}};
  for (const CellSet& set : largest) {
    if (set.empty()) continue;
    GridWindow& window = map.windows.emplace_back();
    for (const int cell : set) {
      map.core_of_cell.data()[static_cast<size_t>(cell)] = static_cast<int>(map.windows.size()) - 1;
      window.Add(cell / cols, cell % cols);
    }
  }
  return map;
}

std::vector<ImageU8> SeparateCores(const EvidenceGrids& evidence) {
  const CoreMap map = MapCores(evidence);
  std::vector<ImageU8> cores;
  for (size_t k = 0; k < map.windows.size(); ++k) {
    cores.push_back(
        CellsWhere(map.core_of_cell, [&](int core) { return core == static_cast<int>(k); }));
  }
  return cores;
}

ImageI CoreOfCells(const GridFrame& frame, const std::vector<ImageU8>& cores) {
  ImageI core_of_cell(frame.rows, frame.cols, 1, -1);
  for (size_t k = 0; k < cores.size(); ++k) {
    for (size_t i = 0; i < core_of_cell.data().size(); ++i) {
      if (cores[k].data()[i] != 0) core_of_cell.data()[i] = static_cast<int>(k);
    }
  }
  return core_of_cell;
}

ImageI AssignTerritories(ImageF solid, const ImageI& core_of_cell) {
  for (float& value : solid.data()) value = 1 + 30 * value;
  return FindCellWays(solid, core_of_cell).source;
}

}  // namespace enfilade
