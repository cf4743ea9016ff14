#include "vantage/bound/exact_schedule.hpp"

#include <algorithm>
#include <bit>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// Calls visit(set) for every set of the views besides view 0 that shows enough with it.
void for_each_cover(const CoverProblem& problem, const std::function<void(std::size_t)>& visit) {
  const std::size_t n = problem.views() - 1;
  const std::function<void(std::size_t, std::size_t, const CellBits&)> extend =
      [&](std::size_t from, std::size_t set, const CellBits& shown) {
        if (count_cells(shown) >= problem.needed) visit(set);
        for (std::size_t view = from; view < n; ++view) {
          CellBits more = shown;
          unite(more, problem.shows[view + 1]);
          extend(view + 1, set | std::size_t{1} << view, more);
        }
      };
  extend(0, 0, problem.shows.front());
}

/// Depth first over sets of views, those that show most first; a set is left where it and what it
/// lacks at least cannot come below the best found.
class SetSearch {
 public:
  /// @param cost_of at least (scans, views taken so far): what any set with them, and with so many
  /// scans in all, costs at least
  using Cost = std::function<double(std::size_t scans, std::span<const std::size_t> taken)>;
  SetSearch(const CoverProblem& problem, std::size_t most_sets, Cost cost)
      : problem_(problem), most_sets_(most_sets), cost_(std::move(cost)) {}

  std::optional<double> least() {
    std::vector<std::size_t> all(problem_.views() - 1);
    std::iota(all.begin(), all.end(), std::size_t{1});
    extend(problem_.shows.front(), all);
    if (sets_ > most_sets_ || best_ == kNoLimit) return std::nullopt;
    return best_;
  }
  [[nodiscard]] std::size_t scans_of_best() const { return scans_of_best_; }

 private:
  struct Gain {
    std::size_t cells;
    std::size_t view;
  };

  std::vector<Gain> gains(const CellBits& shown, const std::vector<std::size_t>& left) const {
    std::vector<Gain> gains;
    for (const std::size_t view : left) {
      const std::size_t cells = count_without(problem_.shows[view], shown);
      if (cells > 0) gains.push_back({cells, view});
    }
    std::ranges::stable_sort(gains, std::greater<>(), &Gain::cells);
    return gains;
  }

  /// Scans that are needed at least; more than there are if all do not suffice.
  static std::size_t scans_for(std::size_t lacking, std::span<const Gain> gains) {
    std::size_t scans = 0;
    for (std::size_t sum = 0; sum < lacking; ++scans) {
      if (scans == gains.size()) return gains.size() + 1;
      sum += gains[scans].cells;
    }
    return scans;
  }

  void extend(const CellBits& shown, const std::vector<std::size_t>& left) {
    if (++sets_ > most_sets_) return;
    const std::size_t seen = count_cells(shown);
    if (seen >= problem_.needed) {
      const double cost = cost_(taken_.size(), taken_);
      if (cost < best_) {
        best_ = cost;
        scans_of_best_ = taken_.size();
      }
      return;
    }
    const std::size_t lacking = problem_.needed - seen;
    const std::vector<Gain> all = gains(shown, left);
    for (std::size_t i = 0; i < all.size() && sets_ <= most_sets_; ++i) {
      // Those before it were tried: from here on they are left out.
      const std::span rest = std::span(all).subspan(i);
      const std::size_t more = scans_for(lacking, rest);
      if (more > rest.size() || cost_(taken_.size() + more, taken_) >= best_) return;
      std::vector<std::size_t> later;
      for (const Gain& gain : rest.subspan(1)) later.push_back(gain.view);
      CellBits with = shown;
      unite(with, problem_.shows[all[i].view]);
      taken_.push_back(all[i].view);
      if (cost_(taken_.size() + more - 1, taken_) < best_) extend(with, later);
      taken_.pop_back();
    }
  }

  const CoverProblem& problem_;
  std::size_t most_sets_;
  Cost cost_;
  std::size_t sets_ = 0;
  double best_ = kNoLimit;
  std::size_t scans_of_best_ = 0;
  std::vector<std::size_t> taken_;
};

}  // namespace

std::optional<LeastSchedule> least_schedule(const CoverProblem& problem) {
  problem.check();
  expects(problem.views() <= kMaxEnumeratedViews + 1, "few views");
  const std::vector<double> way_m = ways_through_sets_m(problem.way_m);
  std::optional<LeastSchedule> least;
  for_each_cover(problem, [&](std::size_t set) {
    const auto scans = static_cast<std::size_t>(std::popcount(set));
    const LeastSchedule one{scans, way_m[set], problem.time_s(way_m[set], scans)};
    if (!least) least = one;
    least->scans = std::min(least->scans, one.scans);
    least->way_m = std::min(least->way_m, one.way_m);
    least->time_s = std::min(least->time_s, one.time_s);
  });
  return least;
}

std::optional<std::size_t> fewest_scans_exactly(const CoverProblem& problem,
                                                std::size_t most_sets) {
  const auto scans = SetSearch(problem, most_sets, [](std::size_t count, auto) {
                       return static_cast<double>(count);
                     }).least();
  if (!scans) return std::nullopt;
  return static_cast<std::size_t>(*scans);
}

std::optional<LeastTime> least_time_exactly(const CoverProblem& problem, std::size_t most_sets) {
  SetSearch search(problem, most_sets, [&](std::size_t count, std::span<const std::size_t> taken) {
    return problem.time_s(shortest_way_m(problem, taken), count);
  });
  const auto time_s = search.least();
  if (!time_s) return std::nullopt;
  return LeastTime{*time_s, search.scans_of_best() <= kMaxExactWay};
}

}  // namespace vantage
