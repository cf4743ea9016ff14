#include "vantage/tasks/mapping/driving/budget.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vantage {
namespace {

/// A way may become longer by that share when its surroundings are seen.
constexpr double kWayReserve = 0.15;
/// For stopping, turning, and planning anew.
constexpr double kReserve_s = 6.0;

}  // namespace

void SpendingRates::observe(const ScanRecord& scan, const ScanRecord* before) {
  if (scan.scan_share >= 1.0) scan_s_ = scan.scan_time_s;
  scanned_s_ += scan.scan_time_s;
  scanned_j_ += scan.scan_energy_j;
  const double since_s = before == nullptr ? 0.0 : before->time_s;
  const double since_j = before == nullptr ? 0.0 : before->energy_j;
  const double drive_s = scan.time_s - scan.scan_time_s - since_s;
  driven_s_ += drive_s;
  driven_j_ += scan.energy_j - scan.scan_energy_j - since_j;
  // The turn at the start is no drive, nor is one that ended short of its goal.
  if (before == nullptr || scan.fallback || !std::isfinite(scan.planned_way_m)) return;
  travel_time_.observe(scan.planned_way_m, drive_s);
}

Allowance Budget::left(const SpendingRates& rates, const Spent& spent) const {
  Allowance left;
  if (options_.time_s) left.time_s = *options_.time_s - spent.time_s - kReserve_s;
  if (options_.energy_j)
    left.energy_j = *options_.energy_j - spent.energy_j - rates.driving_w() * kReserve_s;
  return left;
}

bool Budget::affords(const SpendingRates& rates, const Spent& spent, double driven_m, int drives,
                     int scans) const {
  const TravelTime& travel = rates.travel_time();
  const double driven_s =
      (1.0 + kWayReserve) * (travel.of_m(driven_m) - travel.of_m(0.0)) + drives * travel.of_m(0.0);
  const double scanned_s = scans * rates.scan_s();
  const Allowance now = left(rates, spent);
  const double energy_j = rates.driving_w() * driven_s + rates.scanning_w() * scanned_s;
  return driven_s + scanned_s <= now.time_s && energy_j <= now.energy_j;
}

bool Budget::affords_view(const SpendingRates& rates, const Spent& spent, double way_m,
                          double way_home_m) const {
  return affords(rates, spent, way_m + way_home_m, way_home_m > 0.0 ? 2 : 1, 1);
}

bool Budget::affords_way_home(const SpendingRates& rates, const Spent& spent,
                              double way_home_m) const {
  return affords(rates, spent, way_home_m, way_home_m > 0.0 ? 1 : 0, 1);
}

std::string budget_text(const BudgetOptions& options) {
  std::string text;
  if (options.time_s) text = fmt::format("budget.time_s {:g}", *options.time_s);
  if (options.energy_j) {
    text += fmt::format("{}budget.energy_j {:g}", text.empty() ? "" : " and ", *options.energy_j);
  }
  return text;
}

}  // namespace vantage
