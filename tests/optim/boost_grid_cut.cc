// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/optim/boost_grid_cut.h"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <vector>

namespace enfilade {
namespace {

using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;

struct Edge {
  int64_t capacity = 0;
  int64_t residual = 0;
  Traits::edge_descriptor reverse;
};

using Adjacency =
    boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, boost::no_property, Edge>;

}  // namespace

struct BoostGridCut::Graph {
  Adjacency adjacency;
  size_t source = 0, sink = 0;

  void Connect(size_t a, size_t b, int64_t capacity, int64_t back) {
    const auto there = boost::add_edge(a, b, Edge{capacity, 0, {}}, adjacency).first;
    const auto here = boost::add_edge(b, a, Edge{back, 0, there}, adjacency).first;
    adjacency[there].reverse = here;
  }
};

BoostGridCut::BoostGridCut(const GridCutProblem& problem) : graph_(new Graph) {
  const size_t num_cells = problem.Index(0, 0, problem.layers);
  graph_->adjacency = Adjacency(num_cells + 2);
  graph_->source = num_cells;
  graph_->sink = num_cells + 1;
  const auto join = [&](size_t a, size_t b, int64_t capacity) {
    graph_->Connect(a, b, capacity, capacity);
  };
  for (int layer = 0; layer < problem.layers; ++layer) {
    for (int row = 0; row < problem.rows; ++row) {
      for (int col = 0; col < problem.cols; ++col) {
        const size_t i = problem.Index(row, col, layer);
        graph_->Connect(graph_->source, i, problem.source_capacity[i], 0);
        graph_->Connect(i, graph_->sink, problem.sink_capacity[i], 0);
        if (col + 1 < problem.cols) join(i, i + 1, problem.east_capacity[i]);
        if (row + 1 < problem.rows)
          join(i, problem.Index(row + 1, col, layer), problem.north_capacity[i]);
        if (layer + 1 < problem.layers)
          join(i, problem.Index(row, col, layer + 1), problem.up_capacity[i]);
      }
    }
  }
}

BoostGridCut::~BoostGridCut() = default;

int64_t BoostGridCut::Solve() {
  Adjacency& adjacency = graph_->adjacency;
  const size_t num_vertices = boost::num_vertices(adjacency);
  const auto index = boost::get(boost::vertex_index, adjacency);
  std::vector<Traits::edge_descriptor> predecessor(num_vertices);
  std::vector<boost::default_color_type> color(num_vertices);
  std::vector<int64_t> distance(num_vertices);
  return boost::boykov_kolmogorov_max_flow(
      adjacency, boost::get(&Edge::capacity, adjacency), boost::get(&Edge::residual, adjacency),
      boost::get(&Edge::reverse, adjacency),
      boost::make_iterator_property_map(predecessor.begin(), index),
      boost::make_iterator_property_map(color.begin(), index),
      boost::make_iterator_property_map(distance.begin(), index), index, graph_->source,
      graph_->sink);
}

}  // namespace enfilade
