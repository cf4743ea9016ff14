/// Keeps an episode within its budget: which views can still be taken, when to turn back, and the
/// way home.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "vantage/planners/candidate.hpp"
#include "vantage/tasks/mapping/driving/budget.hpp"
#include "vantage/tasks/mapping/driving/navigator.hpp"

namespace vantage {

class BudgetKeeper {
 public:
  /// Home is where the robot is now. Robot and navigator outlive this; the navigator asks it on
  /// every way whether to go on.
  BudgetKeeper(const BudgetOptions& options, double speed_m_s, MobileRobotInterface& robot,
               Navigator& navigator);
  BudgetKeeper(const BudgetKeeper&) = delete;
  BudgetKeeper& operator=(const BudgetKeeper&) = delete;

  void observe(const ScanRecord& scan, const ScanRecord* before) { rates_.observe(scan, before); }
  /// Marks views that cannot be paid as exhausted. Nothing without a limit.
  void leave_affordable(std::vector<Candidate>& views) const;
  /// Whether the limits leave a view to take.
  [[nodiscard]] bool affords_any(const std::vector<Candidate>& views) const;
  /// Why no view can be taken any more: none is in reach, or none of those is affordable; empty if
  /// one can, or without a limit. @throws EpisodeFailed if that is so after the first scan
  [[nodiscard]] std::string used_up(const std::vector<Candidate>& views, std::size_t scans) const;
  /// Drives home if that is asked for. @throws EpisodeFailed if it does not get there
  void come_home();

  [[nodiscard]] const SpendingRates& rates() const { return rates_; }
  [[nodiscard]] Allowance left() const { return budget_.left(rates_, spent()); }
  /// Travel times home from those places and, last, from here; none if no way home is kept.
  [[nodiscard]] std::vector<double> home_s(std::span<const Eigen::Vector2d> places_m) const;

  void add_metrics(nlohmann::ordered_json& metrics) const;

 private:
  /// To a view, and home if a way home is kept; none to one that is exhausted.
  struct Trip {
    bool has_ways = false;
    bool is_affordable = false;
  };
  [[nodiscard]] std::vector<Trip> trips_to(const std::vector<Candidate>& views) const;
  [[nodiscard]] std::string too_small(std::size_t scans) const;
  [[nodiscard]] bool keeps_way_home() const {
    return budget_.options().is_limited() && budget_.options().return_to_start;
  }
  [[nodiscard]] Spent spent() const { return {robot_.time_s(), robot_.energy_used_j()}; }
  [[nodiscard]] PathField ways_from_home() const;
  [[nodiscard]] double way_home_m(const PathField& from_home, const Eigen::Vector2d& p_m) const;
  [[nodiscard]] bool may_go_on();

  Budget budget_;
  MobileRobotInterface& robot_;
  Navigator& navigator_;
  Pose2 home_;
  SpendingRates rates_;
  double way_home_m_ = 0.0;         ///< from where the robot last knew it
  std::size_t known_at_point_ = 0;  ///< of the navigator's path: there
  bool coming_home_ = false;
  bool returned_ = false;
};

}  // namespace vantage
