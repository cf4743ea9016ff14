#include "vantage/planners/tours/route_search.hpp"

#include <limits>

#include "vantage/core/cancellation/stop_poll.hpp"
#include "vantage/planners/tours/order_moves.hpp"

namespace vantage {
namespace {

using Order = std::vector<std::size_t>;

constexpr std::size_t kLongestMoved = 3;
/// A move must save more than rounding does.
constexpr double kLeastSaved = 1e-9;

class RouteSearch {
 public:
  RouteSearch(const RouteCosts& costs, std::optional<std::size_t> last)
      : costs_(costs), last_(last) {}

  Order run() {
    insert_all();
    while (move_segments() || reverse_segments()) {
    }
    return std::move(order_);
  }

 private:
  [[nodiscard]] double leg(std::size_t from, std::size_t to) const {
    return costs_.cost(static_cast<Eigen::Index>(from), static_cast<Eigen::Index>(to));
  }
  /// The place before the k-th of the route; the start before the first.
  [[nodiscard]] static std::size_t before(const Order& order, std::size_t k, std::size_t start) {
    return k == 0 ? start : order[k - 1];
  }
  /// Places that may change their position: all but a last one that is given.
  [[nodiscard]] std::size_t movable() const { return order_.size() - (last_ ? 1 : 0); }

  void insert_all() {
    if (last_) order_.push_back(*last_);
    std::vector<std::size_t> left;
    for (std::size_t place = 0; place < costs_.places(); ++place) {
      if (place != last_) left.push_back(place);
    }
    while (!left.empty()) insert_cheapest(left);
  }

  void insert_cheapest(std::vector<std::size_t>& left) {
    double cheapest = std::numeric_limits<double>::infinity();
    std::size_t chosen = 0;
    std::size_t position = 0;
    for (std::size_t i = 0; i < left.size(); ++i) {
      poll_stop();
      for (std::size_t k = 0; k <= movable(); ++k) {
        const double more = cost_of_inserting(left[i], k);
        if (more >= cheapest) continue;
        cheapest = more;
        chosen = i;
        position = k;
      }
    }
    order_.insert(order_.begin() + static_cast<std::ptrdiff_t>(position), left[chosen]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(chosen));
  }

  [[nodiscard]] double cost_of_inserting(std::size_t place, std::size_t k) const {
    const std::size_t from = before(order_, k, costs_.places());
    const double there = leg(from, place);
    if (k == order_.size()) return there;
    return there + leg(place, order_[k]) - leg(from, order_[k]);
  }

  /// Keeps the candidate route if it is shorter.
  bool improve(const Order& candidate) {
    if (!(route_cost(costs_, candidate) < route_cost(costs_, order_) - kLeastSaved)) return false;
    order_ = candidate;
    return true;
  }

  /// Or-opt: a few places in a row go elsewhere.
  bool move_segments() {
    bool any = false;
    for (std::size_t length = 1; length <= kLongestMoved; ++length) {
      for (std::size_t from = 0; from + length <= movable(); ++from) {
        poll_stop();
        for (std::size_t to = 0; to + length <= movable(); ++to) {
          if (to != from && improve(with_moved(order_, from, length, to))) any = true;
        }
      }
    }
    return any;
  }

  /// 2-opt: a part is gone through the other way round.
  bool reverse_segments() {
    bool any = false;
    for (std::size_t begin = 0; begin < movable(); ++begin) {
      poll_stop();
      for (std::size_t end = begin + 2; end <= movable(); ++end) {
        if (improve(with_reversed(order_, begin, end))) any = true;
      }
    }
    return any;
  }

  const RouteCosts& costs_;
  std::optional<std::size_t> last_;
  Order order_;
};

}  // namespace

std::vector<std::size_t> searched_route(const RouteCosts& costs, std::optional<std::size_t> last) {
  return RouteSearch(costs, last).run();
}

}  // namespace vantage
