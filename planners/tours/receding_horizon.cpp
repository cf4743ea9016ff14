#include "vantage/planners/tours/receding_horizon.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace vantage {
namespace {

struct Node {
  std::size_t view;    ///< problem.here() at the root
  std::size_t parent;  ///< node
  double cost_s;       ///< from the root, along the tree
  double value;        ///< discounted gain of the branch up to here
};

/// Views in random order, at most so many.
std::vector<std::size_t> drawn(std::vector<std::size_t> views, std::size_t count, Rng& rng) {
  for (std::size_t i = 0; i + 1 < views.size(); ++i) {
    std::swap(views[i], views[i + rng.uniform_index(views.size() - i)]);
  }
  views.resize(std::min(views.size(), count));
  return views;
}

std::size_t nearest_node(const PlanningProblem& problem, const std::vector<Node>& tree,
                         std::size_t view) {
  const auto nearest = std::ranges::min_element(
      tree, {}, [&](const Node& node) { return problem.leg_s(node.view, view); });
  return static_cast<std::size_t>(nearest - tree.begin());
}

std::vector<std::size_t> branch_to(const std::vector<Node>& tree, std::size_t node) {
  std::vector<std::size_t> order;
  for (; node != 0; node = tree[node].parent) order.push_back(tree[node].view);
  std::ranges::reverse(order);
  return order;
}

}  // namespace

PlannedViews RecedingHorizon::operator()(const PlanningProblem& problem, Rng& rng) const {
  std::vector<Node> tree{{problem.here(), 0, 0.0, 0.0}};
  std::size_t best = 0;
  for (const std::size_t view :
       drawn(affordable_views(problem), static_cast<std::size_t>(nodes), rng)) {
    const std::size_t parent = nearest_node(problem, tree, view);
    const double cost_s = tree[parent].cost_s + problem.leg_s(tree[parent].view, view);
    const double gain = gain_of(problem, view) * std::exp(-lambda_per_s * cost_s);
    tree.push_back({view, parent, cost_s, tree[parent].value + gain});
    if (best == 0 || tree.back().value > tree[best].value) best = tree.size() - 1;
  }
  std::vector<std::size_t> order = branch_to(tree, best);
  // The branch may be longer than what is left; its first view alone is affordable or another is.
  while (order.size() > 1 && !is_affordable(problem, order)) order.pop_back();
  return {std::move(order)};
}

}  // namespace vantage
