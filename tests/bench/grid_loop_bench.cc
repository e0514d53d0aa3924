// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0

// The loop solver beside Dijkstra (Boost.Graph) on the graph of long straight edges, as the 2014
// paper puts it: with all edges in memory, and, where there are too many for that, with edges made
// as they are visited. The rivals find the best paths from one given seam; the solver finds the
// best loop over all seams.
#include "enfilade/optim/grid_loop.h"

#include <benchmark/benchmark.h>

#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <boost/iterator/iterator_facade.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <boost/range/irange.hpp>
#include <iterator>
#include <utility>
#include <vector>

#include "tests/bench/grid_homes.h"

namespace enfilade {
namespace {

void BM_FindShortestLoop(benchmark::State& state) {
  const int cols = static_cast<int>(state.range(0)), rows = cols * 15 / 16;
  const GridLoopProblem problem = MakeNoise(rows, cols);
  GridLoopReport report;
  for (auto _ : state) {
    report = FindShortestLoop(problem);
    benchmark::DoNotOptimize(report);
  }
  state.SetItemsProcessed(state.iterations() * rows * cols);
  state.counters["settled"] = static_cast<double>(report.num_settled);
  state.counters["searches"] = report.num_searches;
}
BENCHMARK(BM_FindShortestLoop)
    ->Arg(80)
    ->Arg(160)
    ->Arg(320)
    ->Arg(640)
    ->Arg(1280)
    ->Unit(benchmark::kMillisecond);

constexpr int kRowStep[4] = {0, 1, 0, -1}, kColStep[4] = {1, 0, -1, 0};

// Walks along a straight run; false at its end: at the border, the core or the seam, which no step
// north or south crosses.
struct Run {
  int row, col, cost;
  bool Advance(const GridLoopProblem& p, int heading) {
    cost += p.step_cost[p.StepIndex(row, col, static_cast<GridHeading>(heading))];
    const int from_row = row;
    row += kRowStep[heading];
    col += kColStep[heading];
    const bool crosses_ray =
        heading % 2 == 1 && col > p.cols / 2 && std::min(row, from_row) == p.rows / 2;
    return row >= 0 && col >= 0 && row < p.rows && col < p.cols && !IsCore(p, row, col) &&
           !crosses_ray;
  }
};

using LongEdgeGraph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, int>;

LongEdgeGraph MakeLongEdgeGraph(const GridLoopProblem& p) {
  std::vector<std::pair<int, int>> edges;
  std::vector<int> costs;
  for (int vertex = 0; vertex < p.rows * p.cols; ++vertex) {
    for (int heading = 0; heading < 4; ++heading) {
      Run run{vertex / p.cols, vertex % p.cols, p.turn_cost};
      while (run.Advance(p, heading)) {
        edges.emplace_back(vertex, run.row * p.cols + run.col);
        costs.push_back(run.cost);
      }
    }
  }
  return {boost::edges_are_unsorted_multi_pass, edges.begin(), edges.end(), costs.begin(),
          static_cast<size_t>(p.rows * p.cols)};
}

// The same graph for Boost.Graph without any edge in memory.
struct ImplicitGraph {
  const GridLoopProblem& problem;

  struct Edge {
    int from = 0, to = 0, cost = 0;
    friend bool operator==(const Edge&, const Edge&) = default;
  };
  class EdgeIterator
      : public boost::iterator_facade<EdgeIterator, Edge, boost::forward_traversal_tag, Edge> {
   public:
    EdgeIterator() = default;
    EdgeIterator(const GridLoopProblem& p, int vertex, int heading)
        : p_(&p), vertex_(vertex), heading_(heading) {
      StartRun();
      if (heading < 4) increment();
    }

   private:
    friend class boost::iterator_core_access;
    void StartRun() { run_ = {vertex_ / p_->cols, vertex_ % p_->cols, p_->turn_cost}; }
    void increment() {
      while (!run_.Advance(*p_, heading_)) {
        ++heading_;
        StartRun();
        if (heading_ == 4) return;
      }
    }
    [[nodiscard]] bool equal(const EdgeIterator& other) const {
      return heading_ == other.heading_ && run_.row == other.run_.row && run_.col == other.run_.col;
    }
    [[nodiscard]] Edge dereference() const {
      return {vertex_, run_.row * p_->cols + run_.col, run_.cost};
    }

    const GridLoopProblem* p_ = nullptr;
    int vertex_ = 0, heading_ = 0;
    Run run_{};
  };

  using vertex_descriptor = int;
  using edge_descriptor = Edge;
  using directed_category = boost::directed_tag;
  using edge_parallel_category = boost::disallow_parallel_edge_tag;
  struct traversal_category : boost::incidence_graph_tag, boost::vertex_list_graph_tag {};
  using out_edge_iterator = EdgeIterator;
  using degree_size_type = int;
  using vertex_iterator = boost::range_iterator<boost::integer_range<int>>::type;
  using vertices_size_type = int;

  friend int source(const Edge& edge, const ImplicitGraph&) { return edge.from; }
  friend int target(const Edge& edge, const ImplicitGraph&) { return edge.to; }
  friend std::pair<EdgeIterator, EdgeIterator> out_edges(int vertex, const ImplicitGraph& graph) {
    return {{graph.problem, vertex, 0}, {graph.problem, vertex, 4}};
  }
  friend int out_degree(int vertex, const ImplicitGraph& graph) {
    const auto [first, last] = out_edges(vertex, graph);
    return static_cast<int>(std::distance(first, last));
  }
  friend int num_vertices(const ImplicitGraph& graph) {
    return graph.problem.rows * graph.problem.cols;
  }
  friend std::pair<vertex_iterator, vertex_iterator> vertices(const ImplicitGraph& graph) {
    const auto range = boost::irange(0, num_vertices(graph));
    return {range.begin(), range.end()};
  }
};

template <typename Graph, typename WeightMap>
void RunDijkstra(benchmark::State& state, const GridLoopProblem& p, const Graph& graph,
                 const WeightMap& weights) {
  const size_t num_nodes = static_cast<size_t>(p.rows * p.cols);
  std::vector<int> distance(num_nodes);
  using Vertex = typename boost::graph_traits<Graph>::vertex_descriptor;
  std::vector<Vertex> previous(num_nodes);
  const auto index = boost::typed_identity_property_map<Vertex>();
  const auto start = static_cast<Vertex>((p.rows / 2 + 1) * p.cols + p.cols * 3 / 4);
  for (auto _ : state) {
    boost::dijkstra_shortest_paths(
        graph, start,
        boost::weight_map(weights)
            .vertex_index_map(index)
            .distance_map(boost::make_iterator_property_map(distance.begin(), index))
            .predecessor_map(boost::make_iterator_property_map(previous.begin(), index)));
    benchmark::DoNotOptimize(distance.data());
  }
  state.SetItemsProcessed(state.iterations() * p.rows * p.cols);
  state.counters["across"] = distance[static_cast<size_t>((p.rows / 2) * p.cols + p.cols * 3 / 4)];
}

void BM_BoostDijkstraOnLongEdges(benchmark::State& state) {
  const int cols = static_cast<int>(state.range(0)), rows = cols * 15 / 16;
  const GridLoopProblem problem = MakeNoise(rows, cols);
  const LongEdgeGraph graph = MakeLongEdgeGraph(problem);
  RunDijkstra(state, problem, graph, boost::get(boost::edge_bundle, graph));
  state.counters["edges"] = static_cast<double>(boost::num_edges(graph));
}
BENCHMARK(BM_BoostDijkstraOnLongEdges)->Arg(80)->Arg(160)->Unit(benchmark::kMillisecond);

void BM_BoostDijkstraOnImplicitLongEdges(benchmark::State& state) {
  const int cols = static_cast<int>(state.range(0)), rows = cols * 15 / 16;
  const GridLoopProblem problem = MakeNoise(rows, cols);
  const auto cost_of = [](const ImplicitGraph::Edge& edge) { return edge.cost; };
  RunDijkstra(state, problem, ImplicitGraph{problem},
              boost::make_function_property_map<ImplicitGraph::Edge>(cost_of));
}
BENCHMARK(BM_BoostDijkstraOnImplicitLongEdges)
    ->Arg(80)
    ->Arg(160)
    ->Arg(640)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace enfilade
