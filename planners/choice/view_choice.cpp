#include "vantage/planners/choice/view_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

namespace vantage {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();

/// Index of the best candidate: highest score, then shortest path, then lowest id.
template <class Score>
std::size_t best_by(std::span<const Candidate> candidates, Score&& score) {
  const auto rank = [&](const Candidate& view) {
    return std::tuple(-score(view), view.path_length_m, view.id);
  };
  const auto best = std::ranges::min_element(candidates, {}, rank);
  return static_cast<std::size_t>(best - candidates.begin());
}

}  // namespace

std::size_t RandomView::operator()(std::span<const Candidate> candidates, Rng& rng) const {
  return rng.uniform_index(candidates.size());
}

std::size_t GreedyGain::operator()(std::span<const Candidate> candidates, Rng& /*rng*/) const {
  return best_by(candidates, [](const Candidate& view) { return view.gain_bits; });
}

std::size_t OracleView::operator()(std::span<const Candidate> candidates, Rng& /*rng*/) const {
  return best_by(candidates, [](const Candidate& view) {
    expects(view.true_new_cells.has_value(), "the oracle needs true_new_cells of every candidate");
    return *view.true_new_cells;
  });
}

std::size_t NearestFrontier::operator()(std::span<const Candidate> candidates, Rng& /*rng*/) const {
  return best_by(candidates, [](const Candidate& view) {
    return view.reachable ? -view.path_length_m : kNever;
  });
}

std::size_t GainOverDistance::operator()(std::span<const Candidate> candidates,
                                         Rng& /*rng*/) const {
  return best_by(candidates, [&](const Candidate& view) {
    return view.reachable ? view.gain_bits * std::exp(-lambda_per_m * view.path_length_m) : kNever;
  });
}

Rng choice_stream(const ViewChoice& choice, std::uint64_t seed) {
  const auto* random = std::get_if<RandomView>(&choice);
  if (random == nullptr || random->draw == 0) return Rng::stream(seed, "view choice");
  return Rng::stream(seed, "view choice " + std::to_string(random->draw));
}

ViewChoice within_scans_left(ViewChoice choice, int scans_left) {
  expects(scans_left >= 1, "a view is chosen for a scan");
  const auto limit = [&]<class C>(C& c) {
    if constexpr (requires { c.depth; }) c.depth = std::min(c.depth, scans_left);
  };
  std::visit(limit, choice);
  return choice;
}

std::vector<std::size_t> open_candidates(std::span<const Candidate> candidates) {
  expects(!candidates.empty(), "choose_view needs a candidate");
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (!candidates[i].exhausted) open.push_back(i);
  }
  if (!open.empty()) return open;
  open.resize(candidates.size());
  std::iota(open.begin(), open.end(), 0U);
  return open;
}

std::size_t choose_view(const ViewChoice& choice, std::span<const Candidate> candidates, Rng& rng) {
  return std::visit(
      [&]<class C>(const C& c) -> std::size_t {
        if constexpr (ChoosesView<C>) return choose_view(c, candidates, rng);
        expects(false, "a choice that is a function of candidates");
        return 0;
      },
      choice);
}

bool plans_views(const ViewChoice& choice) {
  return std::visit([]<class C>(const C&) { return PlansViews<C>; }, choice);
}

PlannedViews plan_views(const ViewChoice& choice, const PlanningProblem& problem, Rng& rng) {
  expects(plans_views(choice), "a choice that plans ahead");
  problem.check();
  return std::visit(
      [&]<class C>(const C& c) -> PlannedViews {
        if constexpr (PlansViews<C>) return c(problem, rng);
        return {};
      },
      choice);
}

}  // namespace vantage
