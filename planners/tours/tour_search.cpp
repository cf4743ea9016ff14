#include "vantage/planners/tours/tour_search.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "vantage/core/cancellation/stop_poll.hpp"
#include "vantage/core/error.hpp"
#include "vantage/planners/tours/joint_gain.hpp"
#include "vantage/planners/tours/order_moves.hpp"

namespace vantage {
namespace {

using Order = std::vector<std::size_t>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kLongestSegment = 3;
/// A change must save more than rounding does.
constexpr double kLeastSaved_s = 1e-9;

bool is_cheaper(double cost_s, double than_s) { return cost_s < than_s - kLeastSaved_s; }

Order with(Order order, std::size_t position, std::size_t view) {
  order.insert(order.begin() + static_cast<std::ptrdiff_t>(position), view);
  return order;
}

Order without(Order order, std::size_t position) {
  order.erase(order.begin() + static_cast<std::ptrdiff_t>(position));
  return order;
}

class TourSearch {
 public:
  TourSearch(const PlanningProblem& problem, const TourObjective& objective)
      : problem_(problem), objective_(objective), gain_(problem), adds_(problem.views(), 0.0) {
    for (std::size_t view = 0; view < problem.views(); ++view) gain_.add(view);
    all_ = gain_.total();
    for (std::size_t view = 0; view < problem.views(); ++view) all_ += problem.beyond_of(view);
    all_ = std::max(all_, std::numeric_limits<double>::min());
  }

  /// Without any view if none is worth its time.
  Tour run_as_worth(std::size_t rounds, std::optional<std::size_t> first) {
    fixed_ = first ? 1 : 0;
    order_ = first ? Order{*first} : Order{};
    work_out_gains();
    for (std::size_t round = 0; round < rounds; ++round) {
      const double before_s = tour_.cost_s;
      take_in();
      reorder();
      leave_out();
      if (!is_cheaper(tour_.cost_s, before_s)) break;
    }
    return tour_;
  }

  Tour run(std::size_t rounds, std::optional<std::size_t> first) {
    run_as_worth(rounds, first);
    if (order_.empty()) take_in_one();
    return tour_;
  }

  /// Of the order, with the gains it has.
  double exact_cost_s(std::span<const std::size_t> order) {
    gain_.clear();
    for (const std::size_t view : order) adds_[view] = gain_.add(view);
    return cost_s(order);
  }

  /// With the gains that the views had in the order they were last worked out for; infinite if it
  /// is not affordable.
  [[nodiscard]] double cost_s(std::span<const std::size_t> order) const {
    if (!is_affordable(problem_, order)) return kInfinity;
    double time_s = 0.0;
    double weighted = 0.0;
    double shown = 0.0;
    std::size_t at = problem_.here();
    for (const std::size_t view : order) {
      // Without ways between them, regions are best taken by falling cells per time. [Smith1956]
      const double beyond = problem_.beyond_of(view);
      const double dwell_s = problem_.dwell_s(view);
      time_s += problem_.leg_s(at, view) + objective_.scan_weight * problem_.scan_s_of(view);
      weighted += adds_[view] * time_s + beyond * (time_s + 0.5 * dwell_s);
      time_s += dwell_s;
      shown += adds_[view] + beyond;
      at = view;
    }
    const double unseen = std::max(all_ - shown, 0.0);
    const double mean_s = (weighted + unseen * time_s) / all_;
    const double left_out_s = objective_.worth_s * unseen / (problem_.seen + all_);
    return (1.0 - objective_.finish_weight) * mean_s + objective_.finish_weight * time_s +
           left_out_s;
  }

 private:
  void work_out_gains() {
    tour_.cost_s = exact_cost_s(order_);
    tour_.order = order_;
  }

  /// Takes the order if it is cheaper with the gains that it really has.
  bool accept(const Order& order) {
    const double cost_s = exact_cost_s(order);
    if (!is_cheaper(cost_s, tour_.cost_s)) {
      exact_cost_s(order_);
      return false;
    }
    order_ = order;
    tour_ = {order, cost_s};
    return true;
  }

  struct Change {
    double cost_s = kInfinity;
    Order order;
    void offer(double cost_of_order_s, Order&& offered) {
      if (cost_of_order_s >= cost_s) return;
      cost_s = cost_of_order_s;
      order = std::move(offered);
    }
  };

  /// Views that make the tour cheaper, the best first.
  void take_in() {
    for (;;) {
      const Change best = best_insertion();
      if (!is_cheaper(best.cost_s, tour_.cost_s) || !accept(best.order)) return;
    }
  }

  Change best_insertion() {
    Change best;
    for (std::size_t view = 0; view < problem_.views(); ++view) {
      if (std::ranges::find(order_, view) != order_.end()) continue;
      poll_stop();
      adds_[view] = gain_.of_adding(view);
      for (std::size_t position = fixed_; position <= order_.size(); ++position) {
        Order order = with(order_, position, view);
        const double cost = cost_s(order);
        best.offer(cost, std::move(order));
      }
    }
    return best;
  }

  /// Though it is not worth its time.
  void take_in_one() {
    const Change best = best_insertion();
    if (best.cost_s == kInfinity) return;
    order_ = best.order;
    work_out_gains();
  }

  /// Or-opt and 2-opt with gains that stay, as long as that helps; then the truth of it.
  void reorder() {
    Order order = order_;
    double cost = cost_s(order);
    while (improve_by(order, cost, [&](auto&& offer) { move_segments(order, offer); }) ||
           improve_by(order, cost, [&](auto&& offer) { reverse_segments(order, offer); })) {
    }
    if (order != order_) accept(order);
  }

  template <class Moves>
  bool improve_by(Order& order, double& cost, Moves&& moves) {
    Change best;
    moves([&](Order&& offered) {
      const double cost_of_offered_s = cost_s(offered);
      best.offer(cost_of_offered_s, std::move(offered));
    });
    if (!is_cheaper(best.cost_s, cost)) return false;
    order = std::move(best.order);
    cost = best.cost_s;
    return true;
  }

  template <class Offer>
  void move_segments(const Order& order, Offer&& offer) const {
    for (std::size_t length = 1; length <= kLongestSegment; ++length) {
      for (std::size_t from = fixed_; from + length <= order.size(); ++from) {
        poll_stop();
        for (std::size_t to = fixed_; to + length <= order.size(); ++to) {
          if (to != from) offer(with_moved(order, from, length, to));
        }
      }
    }
  }

  template <class Offer>
  void reverse_segments(const Order& order, Offer&& offer) const {
    for (std::size_t begin = fixed_; begin < order.size(); ++begin) {
      poll_stop();
      for (std::size_t end = begin + 2; end <= order.size(); ++end) {
        offer(with_reversed(order, begin, end));
      }
    }
  }

  /// Views without which the tour is cheaper, each with what is lost without it.
  void leave_out() {
    for (std::size_t position = order_.size(); position-- > fixed_;) {
      if (order_.size() == 1) return;
      poll_stop();
      accept(without(order_, position));
    }
  }

  const PlanningProblem& problem_;
  const TourObjective& objective_;
  JointGain gain_;            ///< of the order
  std::vector<double> adds_;  ///< per view, what it adds in the order
  double all_ = 0.0;          ///< what all views show together, and what lies beyond them
  std::size_t fixed_ = 0;     ///< views at the start of the tour that stay there
  Order order_;
  Tour tour_;  ///< the same with its exact cost
};

}  // namespace

TourObjective with_raised_worth(const PlanningProblem& problem, TourObjective objective,
                                const TourSearchOptions& options) {
  constexpr double kStep = 1.5;
  constexpr int kMaxSteps = 30;
  for (int step = 0; step < kMaxSteps && objective.worth_s > 0.0; ++step) {
    TourSearch search(problem, objective);
    if (!search.run_as_worth(options.rounds, std::nullopt).order.empty()) break;
    objective.worth_s *= kStep;
  }
  return objective;
}

double tour_cost_s(const PlanningProblem& problem, const TourObjective& objective,
                   std::span<const std::size_t> order) {
  return TourSearch(problem, objective).exact_cost_s(order);
}

Tour search_tour(const PlanningProblem& problem, const TourObjective& objective,
                 const TourSearchOptions& options, std::optional<std::size_t> first) {
  problem.check();
  return TourSearch(problem, objective).run(options.rounds, first);
}

std::vector<Tour> search_tours(const PlanningProblem& problem, const TourObjective& wanted,
                               const TourSearchOptions& options) {
  problem.check();
  if (affordable_views(problem).empty()) return {};
  const TourObjective objective = with_raised_worth(problem, wanted, options);
  const Tour free = search_tour(problem, objective, options);
  if (free.order.empty()) return {};
  // How good a first view is, is told by the free tour with that view in front.
  std::vector<std::pair<double, std::size_t>> firsts;
  TourSearch search(problem, objective);
  for (const std::size_t view : affordable_views(problem)) {
    if (view == free.order.front()) continue;
    Order order{view};
    std::ranges::copy_if(free.order, std::back_inserter(order),
                         [&](std::size_t other) { return other != view; });
    while (order.size() > 1 && !is_affordable(problem, order)) order.pop_back();
    firsts.emplace_back(search.exact_cost_s(order), view);
    poll_stop();
  }
  std::ranges::sort(firsts);
  std::vector<Tour> tours{free};
  const auto is_intended = [&](std::size_t view) { return view == problem.intended; };
  std::stable_partition(firsts.begin(), firsts.end(),
                        [&](const auto& first) { return is_intended(first.second); });
  for (const auto& [cost_s, view] : firsts) {
    if (tours.size() >= std::max<std::size_t>(options.first_moves, is_intended(view) ? 2 : 1))
      break;
    tours.push_back(search_tour(problem, objective, options, view));
  }
  std::ranges::stable_sort(tours, {}, [&](const Tour& tour) {
    return tour.cost_s - (is_intended(tour.order.front()) ? options.keep_s : 0.0);
  });
  return tours;
}

std::optional<std::size_t> intended_tour(const PlanningProblem& problem,
                                         std::span<const Tour> tours) {
  for (std::size_t i = 0; i < tours.size(); ++i) {
    if (tours[i].order.front() == problem.intended) return i;
  }
  return std::nullopt;
}

}  // namespace vantage
