/// What an episode may spend, and whether a view can still be taken.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>

#include "vantage/core/fields.hpp"
#include "vantage/planners/tours/planning_problem.hpp"
#include "vantage/planners/travel/travel_time.hpp"
#include "vantage/tasks/mapping/driving/scan_record.hpp"

namespace vantage {

struct BudgetOptions {
  std::optional<double> time_s = {};
  std::optional<double> energy_j = {};
  bool return_to_start = false;
  void fields(auto&& f) {
    f("time_s", time_s,
      "simulated time, from the start of the episode, by which it has to be done; null: no limit",
      above(0.0));
    f("energy_j", energy_j, "energy that the robot has from the start; null: no limit", above(0.0));
    f("return_to_start", return_to_start,
      "true: the way back to the start is part of the budget, and the episode ends there; one that "
      "does not get there has failed");
  }
  [[nodiscard]] bool is_limited() const { return time_s || energy_j; }
};

/// How long the robot takes and what power it draws, as it has learnt it in the episode so far.
class SpendingRates {
 public:
  explicit SpendingRates(double speed_m_s) : travel_time_(speed_m_s) {}

  void observe(const ScanRecord& scan, const ScanRecord* before);
  [[nodiscard]] const TravelTime& travel_time() const { return travel_time_; }
  [[nodiscard]] double scan_s() const { return scan_s_; }
  [[nodiscard]] double driving_w() const { return mean_w(driven_j_, driven_s_); }
  [[nodiscard]] double scanning_w() const { return mean_w(scanned_j_, scanned_s_); }

 private:
  static double mean_w(double energy_j, double time_s) {
    return time_s > 0.0 ? energy_j / time_s : 0.0;
  }

  TravelTime travel_time_;
  double scan_s_ = 0.0;  ///< of the last whole scan
  double driven_s_ = 0.0;
  double driven_j_ = 0.0;
  double scanned_s_ = 0.0;
  double scanned_j_ = 0.0;
};

/// What was spent by now.
struct Spent {
  double time_s = 0.0;
  double energy_j = 0.0;
};

/// What is left of a budget after a reserve for what cannot be foreseen, such as ways round what is
/// seen for the first time.
class Budget {
 public:
  explicit Budget(const BudgetOptions& options) : options_(options) {}

  [[nodiscard]] Allowance left(const SpendingRates& rates, const Spent& spent) const;
  /// Whether a view can be reached and scanned, and the way home driven after it.
  /// @param way_home_m 0 if no way home is kept
  [[nodiscard]] bool affords_view(const SpendingRates& rates, const Spent& spent, double way_m,
                                  double way_home_m) const;
  /// Whether a robot on its way may go on, and scan at its end, and not stop or turn back now.
  /// @param way_home_m 0 if no way home is kept
  [[nodiscard]] bool affords_way_home(const SpendingRates& rates, const Spent& spent,
                                      double way_home_m) const;

  [[nodiscard]] const BudgetOptions& options() const { return options_; }

 private:
  [[nodiscard]] bool affords(const SpendingRates& rates, const Spent& spent, double driven_m,
                             int drives, int scans) const;

  BudgetOptions options_;
};

/// "budget.time_s 600", "budget.time_s 600 and budget.energy_j 9000"
std::string budget_text(const BudgetOptions& options);

}  // namespace vantage
