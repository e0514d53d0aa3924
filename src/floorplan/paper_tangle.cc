// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/paper_tangle.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <utility>

#include "enfilade/base/check.h"

namespace enfilade {
namespace {

using VertexKey = std::pair<int, int>;

VertexKey KeyOf(const GridVertex& vertex) { return {vertex.row, vertex.col}; }

/// All vertices of a closed walk from its corners.
std::vector<GridVertex> AllVertices(const std::vector<GridVertex>& ring) {
  std::vector<GridVertex> vertices;
  for (size_t i = 0; i < ring.size(); ++i) {
    GridVertex at = ring[i];
    const GridVertex& end = ring[(i + 1) % ring.size()];
    while (!(at == end)) {
      vertices.push_back(at);
      at.row += (end.row > at.row) - (end.row < at.row);
      at.col += (end.col > at.col) - (end.col < at.col);
    }
  }
  return vertices;
}

}  // namespace

size_t TangledAnchor(const std::vector<GridVertex>& ring, const std::vector<WallAnchor>& anchors) {
  ENFILADE_CHECK(!anchors.empty());
  const std::vector<GridVertex> walk = AllVertices(ring);
  std::map<VertexKey, size_t> first_visit;
  size_t first = 0, second = 0;
  for (size_t i = 0; i < walk.size() && second == 0; ++i) {
    const auto [place, is_new] = first_visit.try_emplace(KeyOf(walk[i]), i);
    if (is_new) continue;
    first = place->second;
    second = i;
  }
  std::map<VertexKey, size_t> place_of;
  for (size_t i = 0; i < walk.size(); ++i) place_of.try_emplace(KeyOf(walk[i]), i);

  std::vector<size_t> between, around;
  size_t nearest = 0, nearest_steps = walk.size();
  for (size_t k = 0; k < anchors.size(); ++k) {
    const auto place = place_of.find(KeyOf(anchors[k].vertex));
    if (place == place_of.end()) continue;
    const size_t i = place->second;
    (i >= first && i < second ? between : around).push_back(k);
    const size_t apart = i > first ? i - first : first - i;
    const size_t steps = std::min(apart, walk.size() - apart);
    if (steps < nearest_steps) {
      nearest = k;
      nearest_steps = steps;
    }
  }
  if (between.empty() || around.empty()) return nearest;
  const std::vector<size_t>& fewer = around.size() < between.size() ? around : between;
  return *std::min_element(fewer.begin(), fewer.end(), [&](size_t a, size_t b) {
    return anchors[a].points < anchors[b].points;
  });
}

}  // namespace enfilade
