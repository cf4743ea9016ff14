#include "vantage/planners/travel/path_lengths.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "vantage/core/cancellation/stop_poll.hpp"
#include "vantage/core/parallel_for.hpp"
#include "vantage/planners/travel/cost_queue.hpp"

namespace vantage {
namespace {

constexpr float kNoWay = std::numeric_limits<float>::infinity();

}  // namespace

/// The reachable cells of a field as a graph, and its poses in passages, numbered as
/// PathField::parent does. What it takes to go on from a cell is told by the cells: a search reads
/// little memory.
struct FloorGraph {
  struct Step {
    std::ptrdiff_t offset;  ///< of the cell that it leads to
    double length_m;
  };
  struct Edge {
    std::uint32_t to;
    float cost;
    float length_m;
  };
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::size_t kSteps = 8;
  static constexpr unsigned kPassages = 1U << kSteps;

  std::array<Step, kSteps> steps;
  std::vector<double> cost_per_metre;     ///< of each cell
  std::vector<std::uint16_t> ways;        ///< of each node, a bit per step, and kPassages
  std::vector<std::uint32_t> first_edge;  ///< of each node, and one more at the end
  std::vector<Edge> edges;                ///< through passages
  double cell_m;

  [[nodiscard]] std::size_t nodes() const { return ways.size(); }
};

namespace {

bool is_node(const PathField& field, std::size_t cell) {
  return field.reachable(cell) && field.traversable(cell);
}

/// In reading order.
constexpr std::array<std::array<int, 2>, FloorGraph::kSteps> kNeighbours{
    {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

std::array<FloorGraph::Step, FloorGraph::kSteps> steps_of(const FloorMap& map) {
  std::array<FloorGraph::Step, FloorGraph::kSteps> steps{};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto [dx, dy] = kNeighbours[i];
    steps[i] = {static_cast<std::ptrdiff_t>(dy) * map.nx + dx,
                map.cell_m * (dx != 0 && dy != 0 ? std::numbers::sqrt2 : 1.0)};
  }
  return steps;
}

/// A bit per step to another such cell; diagonal ones cut no corner.
unsigned ways_of(const PathField& field, const std::vector<std::uint8_t>& nodes, std::size_t cell) {
  const Eigen::Array2i at = field.map.cell(cell);
  const auto node_at = [&](int dx, int dy) {
    const Eigen::Array2i to = at + Eigen::Array2i(dx, dy);
    return field.map.contains(to) && nodes[field.map.index(to)] != 0;
  };
  unsigned ways = 0;
  for (std::size_t i = 0; i < kNeighbours.size(); ++i) {
    const auto [dx, dy] = kNeighbours[i];
    if (node_at(dx, dy) && node_at(dx, 0) && node_at(0, dy)) ways |= 1U << i;
  }
  return ways;
}

void add_passages(const PathField& field, const std::vector<std::uint8_t>& nodes,
                  FloorGraph& graph) {
  std::vector<std::vector<FloorGraph::Edge>> edges(graph.nodes());
  const auto is_no_node = [&](std::size_t id) { return id < nodes.size() && nodes[id] == 0; };
  for (const NarrowEdge& edge : field.narrow_edges) {
    if (is_no_node(edge.from) || is_no_node(edge.to)) continue;
    const auto cost = static_cast<float>(edge.cost);
    const auto length_m = static_cast<float>(edge.length_m);
    edges[edge.from].push_back({static_cast<std::uint32_t>(edge.to), cost, length_m});
    edges[edge.to].push_back({static_cast<std::uint32_t>(edge.from), cost, length_m});
  }
  for (std::size_t node = 0; node < edges.size(); ++node) {
    graph.first_edge[node] = static_cast<std::uint32_t>(graph.edges.size());
    graph.edges.insert(graph.edges.end(), edges[node].begin(), edges[node].end());
    if (!edges[node].empty()) graph.ways[node] |= FloorGraph::kPassages;
  }
  graph.first_edge.back() = static_cast<std::uint32_t>(graph.edges.size());
}

FloorGraph make_graph(const PathField& field) {
  const std::size_t cells = field.map.size();
  std::vector<std::uint8_t> nodes(cells);
  for (std::size_t cell = 0; cell < cells; ++cell) nodes[cell] = is_node(field, cell) ? 1 : 0;
  FloorGraph graph{.steps = steps_of(field.map),
                   .cost_per_metre = std::vector<double>(cells, 0.0),
                   .ways = std::vector<std::uint16_t>(cells + field.narrow.size(), 0),
                   .first_edge = std::vector<std::uint32_t>(cells + field.narrow.size() + 1, 0),
                   .edges = {},
                   .cell_m = field.map.cell_m};
  for (std::size_t cell = 0; cell < cells; ++cell) {
    if (nodes[cell] == 0) continue;
    graph.cost_per_metre[cell] = field.cost_per_metre(cell);
    graph.ways[cell] = static_cast<std::uint16_t>(ways_of(field, nodes, cell));
  }
  add_passages(field, nodes, graph);
  return graph;
}

/// What stands for each cell; for a nook the pose that it is gone to at.
std::vector<std::uint32_t> nodes_of_cells(const PathField& field) {
  std::vector<std::uint32_t> nodes(field.map.size(), FloorGraph::kNone);
  for (std::size_t cell = 0; cell < nodes.size(); ++cell) {
    if (is_node(field, cell)) nodes[cell] = static_cast<std::uint32_t>(cell);
    if (field.heading_rad(cell)) nodes[cell] = static_cast<std::uint32_t>(field.parent[cell]);
  }
  return nodes;
}

/// What a search knows of a node.
struct Reached {
  float cost = kNoWay;
  float length_m = kNoWay;
};

/// Reaches on from `node`, by cells and through passages.
void expand(const FloorGraph& graph, std::uint32_t node, std::vector<Reached>& reached,
            CostQueue& queue) {
  const Reached from = reached[node];
  const auto reach = [&](std::size_t to, float cost, float length_m) {
    const float through = from.cost + cost;
    if (through >= reached[to].cost) return;
    reached[to] = {through, from.length_m + length_m};
    queue.push(through, static_cast<std::uint32_t>(to));
  };
  const unsigned ways = graph.ways[node];
  for (unsigned left = ways % FloorGraph::kPassages; left != 0; left &= left - 1) {
    const FloorGraph::Step& step = graph.steps[static_cast<std::size_t>(std::countr_zero(left))];
    const auto to = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(node) + step.offset);
    const double per_metre = 0.5 * (graph.cost_per_metre[node] + graph.cost_per_metre[to]);
    reach(to, static_cast<float>(per_metre * step.length_m), static_cast<float>(step.length_m));
  }
  if ((ways & FloorGraph::kPassages) == 0) return;
  for (std::uint32_t e = graph.first_edge[node]; e < graph.first_edge[node + 1]; ++e) {
    reach(graph.edges[e].to, graph.edges[e].cost, graph.edges[e].length_m);
  }
}

/// Length of the cheapest way from `source` to each of `targets`.
std::vector<float> lengths_from(const FloorGraph& graph, std::uint32_t source,
                                std::span<const std::uint32_t> targets) {
  std::vector<Reached> reached(graph.nodes());
  std::vector<std::uint8_t> wanted(graph.nodes(), 0);
  std::size_t left = 0;
  for (const std::uint32_t target : targets) {
    left += 1U - std::exchange(wanted[target], std::uint8_t{1});
  }
  CostQueue queue(graph.cell_m);
  reached[source] = {0.0F, 0.0F};
  queue.push(0.0F, source);
  for (std::size_t settled = 1; left > 0;) {
    const auto next = queue.pop();
    if (!next) break;
    const auto [so_far, node] = *next;
    if (so_far > reached[node].cost) continue;
    if (settled++ % kNodesBetweenPolls == 0) poll_stop();
    left -= std::exchange(wanted[node], std::uint8_t{0});
    expand(graph, node, reached, queue);
  }
  std::vector<float> lengths_m;
  for (const std::uint32_t target : targets) lengths_m.push_back(reached[target].length_m);
  return lengths_m;
}

std::uint64_t pair_of(std::uint32_t a, std::uint32_t b) {
  return (std::uint64_t{std::min(a, b)} << 32U) | std::max(a, b);
}

}  // namespace

PathLengths::PathLengths(const PathField& field)
    : map_(field.map),
      node_of_cell_(nodes_of_cells(field)),
      graph_(std::make_unique<const FloorGraph>(make_graph(field))) {}
PathLengths::~PathLengths() = default;
PathLengths::PathLengths(PathLengths&&) noexcept = default;
PathLengths& PathLengths::operator=(PathLengths&&) noexcept = default;

std::uint32_t PathLengths::node_of(const Eigen::Vector2d& p_m) const {
  const Eigen::Array2i cell = map_.cell_at(p_m);
  return map_.contains(cell) ? node_of_cell_[map_.index(cell)] : FloorGraph::kNone;
}

/// Searches from nodes that are new go first, and to all others: those that were met before are not
/// searched from again for them.
void PathLengths::find(std::span<const std::uint32_t> nodes, int threads) {
  std::vector<std::uint32_t> order(nodes.begin(), nodes.end());
  std::erase(order, FloorGraph::kNone);
  const auto is_new = [&](std::uint32_t node) { return !met_.contains(node); };
  std::stable_partition(order.begin(), order.end(), is_new);
  std::vector<std::vector<std::uint32_t>> targets(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      if (!length_m_.contains(pair_of(order[i], order[j]))) targets[i].push_back(order[j]);
    }
  }
  std::vector<std::vector<float>> found_m(order.size());
  parallel_for(order.size(), threads, [&](std::size_t i) {
    if (!targets[i].empty()) found_m[i] = lengths_from(*graph_, order[i], targets[i]);
    poll_stop();
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t k = 0; k < targets[i].size(); ++k) {
      length_m_.emplace(pair_of(order[i], targets[i][k]), found_m[i][k]);
    }
  }
  met_.insert(order.begin(), order.end());
}

Eigen::MatrixXd PathLengths::between_m(std::span<const Eigen::Vector2d> places_m, int threads) {
  std::vector<std::uint32_t> nodes;
  for (const Eigen::Vector2d& p_m : places_m) nodes.push_back(node_of(p_m));
  find(nodes, threads);
  const auto n = static_cast<Eigen::Index>(nodes.size());
  Eigen::MatrixXd lengths_m = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::uint32_t a = nodes[static_cast<std::size_t>(i)];
    for (Eigen::Index j = i + 1; j < n; ++j) {
      const std::uint32_t b = nodes[static_cast<std::size_t>(j)];
      const bool no_way = a == FloorGraph::kNone || b == FloorGraph::kNone;
      lengths_m(i, j) = lengths_m(j, i) =
          static_cast<double>(no_way ? kNoWay : length_m_.at(pair_of(a, b)));
    }
  }
  return lengths_m;
}

Eigen::MatrixXd path_lengths_m(const PathField& field, std::span<const Eigen::Vector2d> places_m,
                               int threads) {
  return PathLengths(field).between_m(places_m, threads);
}

}  // namespace vantage
