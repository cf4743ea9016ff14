#include "vantage/planners/choice/oracle_lookahead.hpp"

#include <algorithm>
#include <bit>
#include <set>
#include <tuple>
#include <utility>

#include "vantage/core/cancellation/stop_poll.hpp"

namespace vantage {
namespace {

using Sequence = std::vector<std::size_t>;

/// A view that may be taken, with what it shows; cells that no view shows are left out.
struct Option {
  std::size_t candidate;
  double path_length_m;
  CellSet shows;
};

/// A sequence of options, what it shows, and the sum over its steps of the cells shown by then.
struct Plan {
  Sequence options;
  CellSet shown;
  std::size_t value = 0;
};

/// A plan that is not made yet: one of those there are, and an option more.
struct Extension {
  std::size_t plan;
  std::size_t option;
  std::size_t value;
};

std::size_t size_of_union(const CellSet& a, const CellSet& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    count += static_cast<std::size_t>(std::popcount(a[i] | b[i]));
  }
  return count;
}

const CellSet& truth_of(const Candidate& view) {
  expects(view.true_new_cell_set != nullptr,
          "oracle_lookahead needs true_new_cell_set of every candidate");
  return *view.true_new_cell_set;
}

/// Fills in what the options show. Cells are renumbered: only those that some option shows count.
void pack(std::vector<Option>& options, std::span<const Candidate> candidates) {
  const std::size_t words = truth_of(candidates.front()).size();
  std::size_t cells = 0;
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t shown_by_any = 0;
    for (const Option& option : options) shown_by_any |= truth_of(candidates[option.candidate])[w];
    for (; shown_by_any != 0; shown_by_any &= shown_by_any - 1, ++cells) {
      const int from = std::countr_zero(shown_by_any);
      for (Option& option : options) {
        if (cells % 64 == 0) option.shows.push_back(0);
        const std::uint64_t shown = truth_of(candidates[option.candidate])[w] >> from & 1U;
        option.shows.back() |= shown << (cells % 64);
      }
    }
  }
}

std::vector<Option> options_among(std::span<const Candidate> candidates) {
  const bool any_reachable = std::ranges::any_of(candidates, &Candidate::reachable);
  std::vector<Option> options;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& view = candidates[i];
    expects(truth_of(view).size() == truth_of(candidates.front()).size(),
            "sets over the same cells");
    if (view.reachable || !any_reachable) options.push_back({i, view.path_length_m, {}});
  }
  pack(options, candidates);
  return options;
}

std::vector<Extension> extensions(std::span<const Plan> plans, std::span<const Option> options) {
  std::vector<Extension> all;
  for (std::size_t p = 0; p < plans.size(); ++p) {
    poll_stop();
    const Plan& plan = plans[p];
    for (std::size_t o = 0; o < options.size(); ++o) {
      if (std::ranges::find(plan.options, o) != plan.options.end()) continue;
      const std::size_t cells = size_of_union(plan.shown, options[o].shows);
      all.push_back({p, o, plan.value + cells});
    }
  }
  return all;
}

Plan extended(const Plan& plan, const Extension& by, const CellSet& shows) {
  Plan longer = plan;
  longer.options.push_back(by.option);
  for (std::size_t i = 0; i < shows.size(); ++i) longer.shown[i] |= shows[i];
  longer.value = by.value;
  return longer;
}

/// Best first. Of plans that show the same views in another order only the best is kept: whatever
/// follows adds the same to each.
std::vector<Plan> best_of(std::span<const Plan> plans, std::vector<Extension> all,
                          std::span<const Option> options, std::size_t width) {
  const auto rank = [&](const Extension& e) {
    Sequence sequence = plans[e.plan].options;
    sequence.push_back(e.option);
    const double path_length_m = options[sequence.front()].path_length_m;
    return std::tuple(path_length_m, std::move(sequence));
  };
  std::ranges::sort(all, [&](const Extension& a, const Extension& b) {
    return a.value != b.value ? a.value > b.value : rank(a) < rank(b);
  });
  std::vector<Plan> best;
  std::set<Sequence> taken;
  for (const Extension& e : all) {
    if (best.size() == width) break;
    poll_stop();
    Sequence views = plans[e.plan].options;
    views.push_back(e.option);
    std::ranges::sort(views);
    if (!taken.insert(std::move(views)).second) continue;
    best.push_back(extended(plans[e.plan], e, options[e.option].shows));
  }
  return best;
}

}  // namespace

std::vector<std::size_t> OracleLookahead::best_sequence(
    std::span<const Candidate> candidates) const {
  const std::vector<Option> options = options_among(candidates);
  std::vector<Plan> plans(1);
  plans.front().shown.resize(options.front().shows.size());
  const std::size_t steps = std::min(static_cast<std::size_t>(depth), options.size());
  for (std::size_t step = 0; step < steps; ++step) {
    plans = best_of(plans, extensions(plans, options), options, static_cast<std::size_t>(width));
  }
  Sequence sequence = plans.front().options;
  for (std::size_t& option : sequence) option = options[option].candidate;
  return sequence;
}

std::size_t OracleLookahead::operator()(std::span<const Candidate> candidates, Rng& /*rng*/) const {
  return best_sequence(candidates).front();
}

}  // namespace vantage
