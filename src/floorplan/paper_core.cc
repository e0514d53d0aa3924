// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/paper_core.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "enfilade/evidence/ray_traversal.h"
#include "enfilade/floorplan/cells.h"
#include "enfilade/image/distance_transform.h"
#include "src/floorplan/territories.h"

namespace enfilade {
namespace {

constexpr double kCameraSnap_m = 0.25;
constexpr double kOpeningRadius_m = 0.15;
constexpr double kErosion_m = 0.05;
constexpr float kHiddenRays = 3;

// Index of the core at or next to a camera, −1 if there is none.
int CoreAt(const PaperField& field, const std::vector<ImageU8>& cores, const Eigen::Vector2d& p) {
  const GridFrame& frame = field.frame;
  const int reach = static_cast<int>(kCameraSnap_m / frame.cell_m);
  const int row = frame.Row(p.y()), col = frame.Col(p.x());
  int nearest = -1, nearest_distance = reach * reach + 1;
  for (int dr = -reach; dr <= reach; ++dr) {
    for (int dc = -reach; dc <= reach; ++dc) {
      const int distance = dr * dr + dc * dc;
      if (!frame.IsInside(row + dr, col + dc) || distance >= nearest_distance) continue;
      for (size_t k = 0; k < cores.size(); ++k) {
        if (cores[k](row + dr, col + dc) == 0) continue;
        nearest = static_cast<int>(k);
        nearest_distance = distance;
      }
    }
  }
  return nearest;
}

// The cells of the segment if rays pass all of them outside cores; else none.
std::vector<int> FreeLine(const PaperField& field, const ImageI& core_of_cell,
                          const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  std::vector<int> cells;
  bool is_free = true;
  TraverseCells(field.frame, a, b, [&](int row, int col) {
    is_free = core_of_cell(row, col) >= 0 || field.IsFree(row, col);
    cells.push_back(row * field.frame.cols + col);
    return is_free;
  });
  if (!is_free) cells.clear();
  return cells;
}

struct CameraPair {
  double distance_m;
  size_t a, b;
  [[nodiscard]] auto Key() const { return std::tie(distance_m, a, b); }
  friend bool operator<(const CameraPair& x, const CameraPair& y) { return x.Key() < y.Key(); }
};

}  // namespace

std::vector<ImageU8> BridgeCores(const PaperField& field,
                                 const std::vector<EvidenceCamera>& cameras,
                                 const std::vector<ImageU8>& cores) {
  const ImageI core_of_cell = CoreOfCells(field.frame, cores);
  std::vector<int> group(cores.size());
  for (size_t k = 0; k < cores.size(); ++k) group[k] = static_cast<int>(k);
  std::vector<int> camera_core;
  for (const EvidenceCamera& camera : cameras)
    camera_core.push_back(CoreAt(field, cores, camera.position));

  std::vector<CameraPair> pairs;
  for (size_t a = 0; a < cameras.size(); ++a) {
    for (size_t b = a + 1; b < cameras.size(); ++b) {
      if (camera_core[a] >= 0 && camera_core[b] >= 0)
        pairs.push_back({(cameras[a].position - cameras[b].position).norm(), a, b});
    }
  }
  std::sort(pairs.begin(), pairs.end());

  std::vector<ImageU8> joined = cores;
  for (const CameraPair& pair : pairs) {
    const int a = group[static_cast<size_t>(camera_core[pair.a])];
    const int b = group[static_cast<size_t>(camera_core[pair.b])];
    if (a == b) continue;
    const std::vector<int> line =
        FreeLine(field, core_of_cell, cameras[pair.a].position, cameras[pair.b].position);
    // A line that crosses a third core is left to the pairs with cameras there.
    const bool is_clear = std::all_of(line.begin(), line.end(), [&](int cell) {
      const int core = core_of_cell.data()[static_cast<size_t>(cell)];
      return core < 0 || group[static_cast<size_t>(core)] == a ||
             group[static_cast<size_t>(core)] == b;
    });
    if (line.empty() || !is_clear) continue;
    ImageU8 both = joined[static_cast<size_t>(a)];
    const ImageU8& other = joined[static_cast<size_t>(b)];
    for (size_t i = 0; i < both.data().size(); ++i) both.data()[i] |= other.data()[i];
    for (const int cell : line) both.data()[static_cast<size_t>(cell)] = 1;
    if (ConnectedCells(both).size() > 1) continue;  // a camera stands a little beside its core
    joined[static_cast<size_t>(std::min(a, b))] = std::move(both);
    for (int& g : group) {
      if (g == std::max(a, b)) g = std::min(a, b);
    }
  }
  std::vector<ImageU8> result;
  for (size_t k = 0; k < cores.size(); ++k) {
    if (group[k] == static_cast<int>(k)) result.push_back(std::move(joined[k]));
  }
  return result;
}

int AddHiddenSpace(const PaperField& field, const ImageU8& inside, const ImageU8& foreign,
                   double hidden_m2, ImageU8& core) {
  const int rows = field.frame.rows, cols = field.frame.cols;
  const double cell_m = field.frame.cell_m;
  ImageU8 hidden(rows, cols);
  ImageF way_cost(rows, cols, 1, -1);
  ImageI source(rows, cols, 1, -1);
  for (int row = 1; row + 1 < rows; ++row) {
    for (int col = 1; col + 1 < cols; ++col) {
      if (core(row, col) != 0) {
        source(row, col) = 0;
        continue;
      }
      if (foreign(row, col) != 0 || !field.IsFree(row, col)) continue;
      way_cost(row, col) = 1;
      hidden(row, col) = inside(row, col) == 0 && field.is_sure(row, col) != 0 &&
                         field.rays(row, col) >= kHiddenRays && !field.IsSeen(row, col);
    }
  }
  hidden = OpenByDisc(hidden, kOpeningRadius_m / cell_m);
  const CellWays ways = FindCellWays(way_cost, std::move(source));
  int num_spaces = 0;
  for (const CellSet& set : ConnectedCells(hidden)) {
    if (static_cast<double>(set.size()) * cell_m * cell_m < hidden_m2) continue;
    ImageU8 space(rows, cols);
    for (const int cell : set) space.data()[static_cast<size_t>(cell)] = 1;
    for (const CellSet& part : ConnectedCells(ErodeByDisc(space, kErosion_m / cell_m))) {
      const auto nearest = std::min_element(part.begin(), part.end(), [&](int a, int b) {
        return ways.cost.data()[static_cast<size_t>(a)] < ways.cost.data()[static_cast<size_t>(b)];
      });
      if (ways.source.data()[static_cast<size_t>(*nearest)] < 0) continue;
      for (const int cell : part) core.data()[static_cast<size_t>(cell)] = 1;
      for (int cell = *nearest; cell >= 0; cell = ways.parent.data()[static_cast<size_t>(cell)])
        core.data()[static_cast<size_t>(cell)] = 1;
      ++num_spaces;
    }
  }
  return num_spaces;
}

}  // namespace enfilade
