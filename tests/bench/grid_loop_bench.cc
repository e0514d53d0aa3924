// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0

// The loop solver beside Dijkstra (Boost.Graph) on the explicit graph of long straight edges, as
// the 2014 paper puts it. The rival finds the best path for one given seam; the solver finds the
// best loop over all seams.
#include "enfilade/optim/grid_loop.h"

#include <benchmark/benchmark.h>

#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <random>
#include <utility>
#include <vector>

namespace enfilade {
namespace {

// A home of cells×¾cells: dear everywhere but along the walls of a jagged outline round the middle.
GridLoopProblem MakeHome(int rows, int cols) {
  GridLoopProblem problem;
  problem.rows = rows;
  problem.cols = cols;
  problem.turn_cost = 250;
  problem.core.assign(static_cast<size_t>(rows) * static_cast<size_t>(cols), 0);
  for (int row = rows * 3 / 8; row < rows * 5 / 8; ++row) {
    for (int col = cols * 3 / 8; col < cols * 5 / 8; ++col) {
      problem
          .core[static_cast<size_t>(row) * static_cast<size_t>(cols) + static_cast<size_t>(col)] =
          1;
    }
  }
  problem.step_cost.resize(problem.StepIndex(rows + 1, 0, GridHeading::kEast));
  std::mt19937 random(7);
  for (uint16_t& cost : problem.step_cost) cost = static_cast<uint16_t>(5 + random() % 21);
  return problem;
}

void BM_FindShortestLoop(benchmark::State& state) {
  const int cols = static_cast<int>(state.range(0)), rows = cols * 15 / 16;
  const GridLoopProblem problem = MakeHome(rows, cols);
  GridLoopReport report;
  for (auto _ : state) {
    report = FindShortestLoop(problem);
    benchmark::DoNotOptimize(report);
  }
  state.SetItemsProcessed(state.iterations() * rows * cols);
  state.counters["settled"] = static_cast<double>(report.num_settled);
  state.counters["searches"] = report.num_searches;
}
BENCHMARK(BM_FindShortestLoop)->Arg(80)->Arg(160)->Arg(640)->Unit(benchmark::kMillisecond);

using LongEdgeGraph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, int>;

LongEdgeGraph MakeLongEdgeGraph(const GridLoopProblem& p) {
  constexpr int kRowStep[4] = {0, 1, 0, -1}, kColStep[4] = {1, 0, -1, 0};
  const auto is_core = [&](int row, int col) {
    return p.core[static_cast<size_t>(row * p.cols + col)] != 0;
  };
  std::vector<std::pair<int, int>> edges;
  std::vector<int> costs;
  for (int row = 0; row < p.rows; ++row) {
    for (int col = 0; col < p.cols; ++col) {
      for (int heading = 0; heading < 4; ++heading) {
        int cost = p.turn_cost;
        for (int r = row, c = col;;) {
          cost += p.step_cost[p.StepIndex(r, c, static_cast<GridHeading>(heading))];
          r += kRowStep[heading];
          c += kColStep[heading];
          // The seam: below the ray no step leads north.
          const bool crosses_ray = heading % 2 == 1 && c > p.cols / 2 &&
                                   std::min(r, r - kRowStep[heading]) == p.rows / 2;
          if (r < 0 || c < 0 || r >= p.rows || c >= p.cols || is_core(r, c) || crosses_ray) break;
          edges.emplace_back(row * p.cols + col, r * p.cols + c);
          costs.push_back(cost);
        }
      }
    }
  }
  return {boost::edges_are_unsorted_multi_pass, edges.begin(), edges.end(), costs.begin(),
          static_cast<size_t>(p.rows * p.cols)};
}

void BM_BoostDijkstraOnLongEdges(benchmark::State& state) {
  const int cols = static_cast<int>(state.range(0)), rows = cols * 15 / 16;
  const LongEdgeGraph graph = MakeLongEdgeGraph(MakeHome(rows, cols));
  const size_t num_nodes = boost::num_vertices(graph);
  std::vector<int> distance(num_nodes);
  std::vector<size_t> previous(num_nodes);
  const auto index = boost::get(boost::vertex_index, graph);
  const size_t start = static_cast<size_t>((rows / 2 + 1) * cols + cols * 3 / 4);
  for (auto _ : state) {
    boost::dijkstra_shortest_paths(
        graph, start,
        boost::weight_map(boost::get(boost::edge_bundle, graph))
            .distance_map(boost::make_iterator_property_map(distance.begin(), index))
            .predecessor_map(boost::make_iterator_property_map(previous.begin(), index)));
    benchmark::DoNotOptimize(distance.data());
  }
  state.SetItemsProcessed(state.iterations() * rows * cols);
  state.counters["edges"] = static_cast<double>(boost::num_edges(graph));
}
BENCHMARK(BM_BoostDijkstraOnLongEdges)->Arg(80)->Arg(160)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace enfilade
