// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/optim/ordered_labels.h"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "enfilade/base/check.h"

namespace enfilade {
namespace {

using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;

struct Arc {
  int64_t capacity = 0;
  int64_t residual = 0;
  Traits::edge_descriptor reverse;
};

using Graph =
    boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, boost::no_property, Arc>;

// The cut whose source side holds vertex (node, i), i = 1 … K − 1, when the node's label is i or
// more.
class LabelCut {
 public:
  LabelCut(std::span<const double> costs, int num_labels, std::span<const LabelEdge> edges)
      : num_nodes_(costs.size() / static_cast<size_t>(num_labels)),
        num_levels_(static_cast<size_t>(num_labels) - 1),
        source_(num_nodes_ * num_levels_),
        sink_(source_ + 1),
        graph_(sink_ + 1) {
    double largest = 0;
    for (const double cost : costs) largest = std::max(largest, std::abs(cost));
    for (const LabelEdge& edge : edges) largest = std::max({largest, edge.p_above, edge.q_above});
    scale_ = largest > 0 ? std::ldexp(1.0, 20) / largest : 1;
    for (size_t p = 0; p < num_nodes_; ++p) {
      AddChain(p,
               costs.subspan(p * static_cast<size_t>(num_labels), static_cast<size_t>(num_labels)));
    }
    for (const LabelEdge& edge : edges) {
      const auto p = static_cast<size_t>(edge.p), q = static_cast<size_t>(edge.q);
      ENFILADE_CHECK(edge.p_above >= 0 && edge.q_above >= 0 && p < num_nodes_ && q < num_nodes_ &&
                     p != q);
      for (size_t level = 0; level < num_levels_; ++level)
        Connect(Vertex(p, level), Vertex(q, level), Rounded(edge.p_above), Rounded(edge.q_above));
    }
  }

  std::vector<int> Solve() {
    const size_t num_vertices = boost::num_vertices(graph_);
    const auto index = boost::get(boost::vertex_index, graph_);
    std::vector<Traits::edge_descriptor> predecessor(num_vertices);
    std::vector<boost::default_color_type> color(num_vertices);
    std::vector<int64_t> distance(num_vertices);
    boost::boykov_kolmogorov_max_flow(
        graph_, boost::get(&Arc::capacity, graph_), boost::get(&Arc::residual, graph_),
        boost::get(&Arc::reverse, graph_),
        boost::make_iterator_property_map(predecessor.begin(), index),
        boost::make_iterator_property_map(color.begin(), index),
        boost::make_iterator_property_map(distance.begin(), index), index, source_, sink_);
    const std::vector<uint8_t> is_reached = ReachedFromSource();
    std::vector<int> label(num_nodes_);
    for (size_t p = 0; p < num_nodes_; ++p) {
      for (size_t level = 0; level < num_levels_; ++level) label[p] += is_reached[Vertex(p, level)];
    }
    return label;
  }

 private:
  // source → (p, 1) → … → (p, K − 1) → sink; the arc that is cut is the label. Backwards there is
  // no end of capacity, so that it is one arc.
  void AddChain(size_t p, std::span<const double> costs) {
    const double least = *std::min_element(costs.begin(), costs.end());
    for (size_t label = 0; label <= num_levels_; ++label) {
      ENFILADE_CHECK(std::isfinite(costs[label]));
      const size_t from = label == 0 ? source_ : Vertex(p, label - 1);
      const size_t to = label == num_levels_ ? sink_ : Vertex(p, label);
      const bool is_inner = label > 0 && label < num_levels_;
      Connect(from, to, Rounded(costs[label] - least), is_inner ? kNoEnd : 0);
    }
  }

  [[nodiscard]] size_t Vertex(size_t node, size_t level) const {
    return node * num_levels_ + level;
  }
  [[nodiscard]] int64_t Rounded(double cost) const { return std::llround(cost * scale_); }

  void Connect(size_t a, size_t b, int64_t capacity, int64_t back) {
    const auto there = boost::add_edge(a, b, Arc{capacity, 0, {}}, graph_).first;
    const auto here = boost::add_edge(b, a, Arc{back, 0, there}, graph_).first;
    graph_[there].reverse = here;
  }

  // The smallest source side: the same for every largest flow.
  [[nodiscard]] std::vector<uint8_t> ReachedFromSource() const {
    std::vector<uint8_t> is_reached(boost::num_vertices(graph_));
    std::vector<size_t> stack = {source_};
    is_reached[source_] = 1;
    while (!stack.empty()) {
      const size_t vertex = stack.back();
      stack.pop_back();
      const auto [begin, end] = boost::out_edges(vertex, graph_);
      for (auto arc = begin; arc != end; ++arc) {
        const size_t next = boost::target(*arc, graph_);
        if (graph_[*arc].residual <= 0 || is_reached[next] != 0) continue;
        is_reached[next] = 1;
        stack.push_back(next);
      }
    }
    return is_reached;
  }

  static constexpr int64_t kNoEnd = int64_t{1} << 50;

  size_t num_nodes_, num_levels_, source_, sink_;
  double scale_ = 1;
  Graph graph_;
};

double EnergyOf(std::span<const double> costs, int num_labels, std::span<const LabelEdge> edges,
                const std::vector<int>& label) {
  double energy = 0;
  for (size_t p = 0; p < label.size(); ++p)
    energy += costs[p * static_cast<size_t>(num_labels) + static_cast<size_t>(label[p])];
  for (const LabelEdge& edge : edges) {
    const int steps = label[static_cast<size_t>(edge.p)] - label[static_cast<size_t>(edge.q)];
    energy += steps > 0 ? steps * edge.p_above : -steps * edge.q_above;
  }
  return energy;
}

}  // namespace

OrderedLabels FindOrderedLabels(std::span<const double> costs, int num_labels,
                                std::span<const LabelEdge> edges) {
  ENFILADE_CHECK(num_labels >= 2 && costs.size() % static_cast<size_t>(num_labels) == 0);
  OrderedLabels result;
  if (costs.empty()) return result;
  result.label = LabelCut(costs, num_labels, edges).Solve();
  result.energy = EnergyOf(costs, num_labels, edges, result.label);
  return result;
}

}  // namespace enfilade
