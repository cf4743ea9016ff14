#include "vantage/tasks/mapping/plans/plan_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace vantage {
namespace {

constexpr std::string_view kPlans = "plans.csv";

/// Empty if there is none.
std::string number_or_none(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : std::string();
}

}  // namespace

PlanTable::PlanTable(const std::filesystem::path& run_dir) : file_(run_dir / kPlans) {
  file_.write(
      "scan,time_s,change,saved_s,stop,candidate,x_m,y_m,yaw_rad,arrival_s,departure_s,gain,beyond,"
      "gain_unit\n");
}

void PlanTable::add(const PlannedTour& tour, const PlanMoment& moment) {
  const std::string of_plan =
      fmt::format("{},{},{},{}", moment.scan, moment.time_s, name_of(tour.reason.change),
                  number_or_none(tour.reason.saved_s));
  for (std::size_t i = 0; i < tour.stops.size(); ++i) {
    const PlannedStop& stop = tour.stops[i];
    file_.write(fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", of_plan, i + 1,
                            stop.id < 0 ? std::string() : std::to_string(stop.id), stop.place_m.x(),
                            stop.place_m.y(), stop.yaw_rad, stop.arrival_s, stop.departure_s,
                            stop.gain, stop.beyond, moment.gain_unit));
  }
}

RecordTexts plan_records() {
  return {
      {kRunFolder, kPlans,
       "mapping, with a choice that plans ahead: a row a stop of the tour that each decision "
       "intends; not with --lean"},
      {kPlans, "scan",
       "of steps.csv, that the decision leads to: one more than decision of candidates.csv"},
      {kPlans, "time_s", "simulated, when it was planned"},
      {kPlans, "change",
       "why the tour begins where it does, against the plan before. first: there was none; ended: "
       "that one intended no further view; kept: the view that was intended next, or the nearest "
       "within 1.5 m of it, is taken; gone: no such view is among those that can be taken; "
       "exhausted: it is expected to show nothing new any more; unreachable: no way leads there; "
       "unaffordable: what is left of the budget does not pay for it; cheaper: another tour costs "
       "less than the best one found that begins there; replanned: the choice takes another view "
       "and weighs no tours that would tell why"},
      {kPlans, "saved_s",
       "of cheaper: by how much, of the tour's cost in s; empty: of all other changes"},
      {kPlans, "stop", "number of the stop, 1 is the view that is taken next"},
      {kPlans, "candidate",
       "id of the view, as chosen_view of steps.csv has it; empty: one that cannot be proposed yet "
       "(oracle_tour)"},
      {kPlans, "x_m", "of the base, world"},
      {kPlans, "y_m", "of the base, world"},
      {kPlans, "yaw_rad", "heading of the base, world"},
      {kPlans, "arrival_s", "predicted, from time_s"},
      {kPlans, "departure_s",
       "predicted, from time_s: the scan is done, and what lies beyond is observed; of the last "
       "stop the end of the tour"},
      {kPlans, "gain",
       "what the stop is expected to add to what those before it show, by the gain in use"},
      {kPlans, "beyond",
       "unknown space behind what all views show that the stop leads to, as far as the choice "
       "counts it (planning.beyond_m)"},
      {kPlans, "gain_unit", "what gain and beyond count"},
  };
}

}  // namespace vantage
