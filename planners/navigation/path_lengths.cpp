#include "vantage/planners/navigation/path_lengths.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>
#include <vector>

#include "vantage/core/cancellation/stop_poll.hpp"
#include "vantage/core/parallel_for.hpp"

namespace vantage {
namespace {

constexpr float kNoWay = std::numeric_limits<float>::infinity();

/// The reachable cells of a field as a graph of their own, and its poses in passages.
struct FloorGraph {
  struct Edge {
    std::uint32_t to;
    float cost;
    float length_m;
  };
  std::vector<std::uint32_t> node_of;     ///< of each cell of the map; kNone: not in the graph
  std::vector<std::uint32_t> first_edge;  ///< of each node, and one more at the end
  std::vector<Edge> edges;
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  [[nodiscard]] std::size_t nodes() const { return first_edge.size() - 1; }
};

bool is_node(const PathField& field, std::size_t cell) {
  return field.reachable(cell) && field.traversable(cell);
}

/// Edges through passages, a list per node.
using MoreEdges = std::vector<std::vector<FloorGraph::Edge>>;

void add_edges(const PathField& field, std::size_t cell, FloorGraph& graph) {
  const Eigen::Array2i at = field.map.cell(cell);
  const auto node_at = [&](int dx, int dy) {
    const Eigen::Array2i to = at + Eigen::Array2i(dx, dy);
    return field.map.contains(to) ? graph.node_of[field.map.index(to)] : FloorGraph::kNone;
  };
  const double here = field.cost_per_metre(cell);
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const std::uint32_t to = dx == 0 && dy == 0 ? FloorGraph::kNone : node_at(dx, dy);
      if (to == FloorGraph::kNone) continue;
      const bool diagonal = dx != 0 && dy != 0;
      const bool cuts_corner =
          diagonal && (node_at(dx, 0) == FloorGraph::kNone || node_at(0, dy) == FloorGraph::kNone);
      if (cuts_corner) continue;
      const double length_m = field.map.cell_m * (diagonal ? std::numbers::sqrt2 : 1.0);
      const double there = field.cost_per_metre(field.map.index(at + Eigen::Array2i(dx, dy)));
      graph.edges.push_back(
          {to, static_cast<float>(0.5 * (here + there) * length_m), static_cast<float>(length_m)});
    }
  }
}

/// Poses in passages come after the cells.
void add_passages(const PathField& field, std::uint32_t cells, const FloorGraph& graph,
                  MoreEdges& more) {
  const auto node_of = [&](std::size_t id) {
    return id < field.map.size() ? graph.node_of[id]
                                 : cells + static_cast<std::uint32_t>(id - field.map.size());
  };
  for (const NarrowEdge& edge : field.narrow_edges) {
    const std::uint32_t from = node_of(edge.from);
    const std::uint32_t to = node_of(edge.to);
    if (from == FloorGraph::kNone || to == FloorGraph::kNone) continue;
    const auto cost = static_cast<float>(edge.cost);
    const auto length_m = static_cast<float>(edge.length_m);
    more[from].push_back({to, cost, length_m});
    more[to].push_back({from, cost, length_m});
  }
}

FloorGraph make_graph(const PathField& field) {
  FloorGraph graph;
  graph.node_of.assign(field.map.size(), FloorGraph::kNone);
  std::vector<std::size_t> cells;
  for (std::size_t cell = 0; cell < field.map.size(); ++cell) {
    if (!is_node(field, cell)) continue;
    graph.node_of[cell] = static_cast<std::uint32_t>(cells.size());
    cells.push_back(cell);
  }
  MoreEdges more(cells.size() + field.narrow.size());
  add_passages(field, static_cast<std::uint32_t>(cells.size()), graph, more);
  for (std::size_t node = 0; node < more.size(); ++node) {
    graph.first_edge.push_back(static_cast<std::uint32_t>(graph.edges.size()));
    if (node < cells.size()) add_edges(field, cells[node], graph);
    graph.edges.insert(graph.edges.end(), more[node].begin(), more[node].end());
  }
  graph.first_edge.push_back(static_cast<std::uint32_t>(graph.edges.size()));
  // A nook stands for the pose that it is gone to at.
  for (std::size_t cell = 0; cell < field.map.size(); ++cell) {
    if (!field.heading_rad(cell)) continue;
    graph.node_of[cell] =
        static_cast<std::uint32_t>(cells.size() + field.parent[cell] - field.map.size());
  }
  return graph;
}

/// Length of the cheapest way from `source` to each of `targets`.
std::vector<float> lengths_from(const FloorGraph& graph, std::uint32_t source,
                                std::span<const std::uint32_t> targets) {
  std::vector<float> cost(graph.nodes(), kNoWay);
  std::vector<float> length_m(graph.nodes(), kNoWay);
  std::vector<std::uint8_t> wanted(graph.nodes(), 0);
  std::size_t left = 0;
  for (const std::uint32_t target : targets) {
    if (target == FloorGraph::kNone || wanted[target] != 0) continue;
    wanted[target] = 1;
    ++left;
  }
  using Entry = std::pair<float, std::uint32_t>;  // ties by index: the same way every time
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  cost[source] = 0.0F;
  length_m[source] = 0.0F;
  queue.emplace(0.0F, source);
  for (std::size_t settled = 1; !queue.empty() && left > 0;) {
    const auto [so_far, node] = queue.top();
    queue.pop();
    if (so_far > cost[node]) continue;
    if (settled++ % kNodesBetweenPolls == 0) poll_stop();
    left -= std::exchange(wanted[node], std::uint8_t{0});
    for (std::uint32_t e = graph.first_edge[node]; e < graph.first_edge[node + 1]; ++e) {
      const FloorGraph::Edge& edge = graph.edges[e];
      const float through = so_far + edge.cost;
      if (through >= cost[edge.to]) continue;
      cost[edge.to] = through;
      length_m[edge.to] = length_m[node] + edge.length_m;
      queue.emplace(through, edge.to);
    }
  }
  std::vector<float> lengths_m;
  for (const std::uint32_t target : targets) {
    lengths_m.push_back(target == FloorGraph::kNone ? kNoWay : length_m[target]);
  }
  return lengths_m;
}

}  // namespace

Eigen::MatrixXd path_lengths_m(const PathField& field, std::span<const Eigen::Vector2d> places_m,
                               int threads) {
  const FloorGraph graph = make_graph(field);
  std::vector<std::uint32_t> nodes;
  for (const Eigen::Vector2d& p_m : places_m) {
    const Eigen::Array2i cell = field.map.cell_at(p_m);
    nodes.push_back(field.map.contains(cell) ? graph.node_of[field.map.index(cell)]
                                             : FloorGraph::kNone);
  }
  const auto n = static_cast<Eigen::Index>(nodes.size());
  Eigen::MatrixXd lengths_m =
      Eigen::MatrixXd::Constant(n, n, std::numeric_limits<double>::infinity());
  parallel_for(nodes.size(), threads, [&](std::size_t i) {
    const auto row = static_cast<Eigen::Index>(i);
    lengths_m(row, row) = 0.0;
    if (nodes[i] == FloorGraph::kNone) return;
    const auto later = std::span(nodes).subspan(i + 1);
    const std::vector<float> found_m = lengths_from(graph, nodes[i], later);
    poll_stop();
    for (std::size_t k = 0; k < found_m.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(i + 1 + k);
      lengths_m(row, column) = lengths_m(column, row) = static_cast<double>(found_m[k]);
    }
  });
  return lengths_m;
}

}  // namespace vantage
