#include "vantage/tasks/mapping/driving/budget_keeper.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

#include "vantage/core/log.hpp"
#include "vantage/runtime/episode_loop.hpp"

namespace vantage {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

BudgetKeeper::BudgetKeeper(const BudgetOptions& options, double speed_m_s,
                           MobileRobotInterface& robot, Navigator& navigator)
    : budget_(options),
      robot_(robot),
      navigator_(navigator),
      home_(robot.estimated_base()),
      rates_(speed_m_s) {
  if (options.is_limited()) navigator_.may_go_on = [this] { return may_go_on(); };
}

PathField BudgetKeeper::ways_from_home() const { return navigator_.ways_from(home_); }

/// Of a place that is not reachable, infinite: no view is taken from which there is no way back.
double BudgetKeeper::way_home_m(const PathField& from_home, const Eigen::Vector2d& p_m) const {
  return path_length_m(from_home, {p_m.x(), p_m.y(), 0.0});
}

std::vector<BudgetKeeper::Trip> BudgetKeeper::trips_to(const std::vector<Candidate>& views) const {
  const bool home = keeps_way_home();
  const PathField from_home = home ? ways_from_home() : PathField{};
  const auto from_here = navigator_.plan();
  std::vector<Trip> trips;
  for (const Candidate& view : views) {
    if (view.exhausted) {
      trips.emplace_back();
      continue;
    }
    const Pose2 base = robot_.base_for_sensor(view.T_world_sensor);
    const double back_m = home ? way_home_m(from_home, position(base)) : 0.0;
    // One that is too far from what it is to look at may be taken for want of a better one.
    const double way_m = view.reachable ? view.path_length_m : path_length_m(*from_here, base);
    const bool has_ways = std::isfinite(way_m) && std::isfinite(back_m);
    trips.push_back({has_ways, has_ways && budget_.affords_view(rates_, spent(), way_m, back_m)});
  }
  return trips;
}

void BudgetKeeper::leave_affordable(std::vector<Candidate>& views) const {
  if (!budget_.options().is_limited()) return;
  const std::vector<Trip> trips = trips_to(views);
  for (std::size_t i = 0; i < views.size(); ++i) views[i].exhausted = !trips[i].is_affordable;
}

bool BudgetKeeper::affords_any(const std::vector<Candidate>& views) const {
  return !budget_.options().is_limited() ||
         std::ranges::any_of(trips_to(views), &Trip::is_affordable);
}

std::string BudgetKeeper::used_up(const std::vector<Candidate>& views, std::size_t scans) const {
  if (!budget_.options().is_limited()) return {};
  const std::vector<Trip> trips = trips_to(views);
  if (std::ranges::any_of(trips, &Trip::is_affordable)) return {};
  if (std::ranges::any_of(trips, &Trip::has_ways)) return too_small(scans);
  const std::string reason =
      std::string("no view is left in reach") + (keeps_way_home() ? " that has a way back" : "");
  if (scans <= 1) throw EpisodeFailed(reason);
  return reason;
}

std::string BudgetKeeper::too_small(std::size_t scans) const {
  const std::string limit = budget_text(budget_.options());
  if (scans <= 1) {
    throw EpisodeFailed(limit + ": too small to go anywhere and scan again" +
                        (keeps_way_home() ? " and come back" : ""));
  }
  return fmt::format("{} allow{} no further view", limit,
                     budget_.options().time_s && budget_.options().energy_j ? "" : "s") +
         (keeps_way_home() ? " and the way back" : "");
}

/// The way home as it was last known, and back what was driven since.
bool BudgetKeeper::may_go_on() {
  if (coming_home_) return true;
  // To the first scan, without which nothing can be said, it goes anyway.
  if (!keeps_way_home()) {
    return rates_.scan_s() == 0.0 || budget_.affords_way_home(rates_, spent(), 0.0);
  }
  const auto& path_m = navigator_.path_m();
  double way_m = way_home_m_;
  for (std::size_t i = known_at_point_ + 1; i < path_m.size(); ++i) {
    way_m += (path_m[i] - path_m[i - 1]).norm();
  }
  if (budget_.affords_way_home(rates_, spent(), way_m)) return true;
  // Most often there is a shorter one.
  const double known_m = way_home_m(ways_from_home(), position(robot_.estimated_base()));
  if (std::isfinite(known_m)) {
    way_home_m_ = known_m;
    known_at_point_ = path_m.empty() ? 0 : path_m.size() - 1;
    way_m = known_m;
  }
  return budget_.affords_way_home(rates_, spent(), way_m);
}

void BudgetKeeper::come_home() {
  if (!budget_.options().return_to_start) return;
  coming_home_ = true;
  returned_ = navigator_.approach(home_, std::nullopt).reached;
  if (!returned_) throw EpisodeFailed("budget.return_to_start: the start was not reached");
}

std::vector<double> BudgetKeeper::home_s(std::span<const Eigen::Vector2d> places_m) const {
  if (!keeps_way_home()) return {};
  const PathField from_home = ways_from_home();
  std::vector<double> times_s;
  for (const Eigen::Vector2d& place_m : places_m) {
    times_s.push_back(rates_.travel_time().of_m(way_home_m(from_home, place_m)));
  }
  const double here_m = way_home_m(from_home, position(robot_.estimated_base()));
  times_s.push_back(std::isfinite(here_m) ? rates_.travel_time().of_m(here_m) : kInfinity);
  return times_s;
}

void BudgetKeeper::add_metrics(nlohmann::ordered_json& metrics) const {
  using Json = nlohmann::ordered_json;
  const BudgetOptions& options = budget_.options();
  metrics["energy_j"] = robot_.energy_used_j();
  if (!options.is_limited() && !options.return_to_start) return;
  const bool in_time = !options.time_s || robot_.time_s() <= *options.time_s;
  const bool in_energy = !options.energy_j || robot_.energy_used_j() <= *options.energy_j;
  const Eigen::Vector2d off_m = position(robot_.estimated_base()) - position(home_);
  metrics["budget"] = {{"time_s", options.time_s ? Json(*options.time_s) : Json()},
                       {"energy_j", options.energy_j ? Json(*options.energy_j) : Json()},
                       {"return_to_start", options.return_to_start},
                       {"kept", in_time && in_energy && (!options.return_to_start || returned_)},
                       {"returned", returned_},
                       {"from_start_m", off_m.norm()}};
}

}  // namespace vantage
