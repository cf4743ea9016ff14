#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <cmath>
#include <limits>

#include "python/bindings.hpp"
#include "python/kit/arrays.hpp"
#include "python/kit/calls.hpp"
#include "python/kit/options.hpp"
#include "python/planning/grids.hpp"
#include "vantage/geometry/rgbd_camera.hpp"
#include "vantage/planners/choice/view_choice.hpp"
#include "vantage/planners/choice/view_problem.hpp"
#include "vantage/planners/tours/route.hpp"

namespace vantage::python {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Eigen::Index kMaxViews = 2000;  // travel times are a square matrix

/// Of times or costs: at least 0, infinite where there is no way.
Eigen::MatrixXd times_of(const Doubles& array, const std::string& argument) {
  if (array.ndim() != 2 || array.shape(0) != array.shape(1) + 1 || array.shape(1) > kMaxViews) {
    refuse(argument,
           fmt::format("shape {} is not (n + 1, n), n at most {}", shape_text(array), kMaxViews));
  }
  for (py::ssize_t i = 0; i < array.size(); ++i) {
    if (!(array.data()[i] >= 0.0))
      refuse(argument, fmt::format("{} is not at least 0", array.data()[i]));
  }
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const Rows>(array.data(), array.shape(0), array.shape(1));
}

double at_least_0(double value, const char* argument) {
  if (!(value >= 0.0)) refuse(argument, fmt::format("{} is not at least 0", value));
  return value;
}

std::vector<float> cells_of(const Doubles& cells) {
  if (cells.ndim() != 1) refuse("cells", "shape " + shape_text(cells) + " is not (b,)");
  std::vector<float> values;
  for (py::ssize_t i = 0; i < cells.size(); ++i) {
    if (!(cells.data()[i] >= 0.0 && cells.data()[i] < 1e30))
      refuse("cells", "not at least 0 and finite");
    values.push_back(static_cast<float>(cells.data()[i]));
  }
  return values;
}

std::vector<ShownShares> shows_of(const Doubles& shows, std::size_t blocks) {
  if (shows.ndim() != 2 || shows.shape(1) != static_cast<py::ssize_t>(blocks)) {
    refuse("shows", fmt::format("shape {} is not (n, {})", shape_text(shows), blocks));
  }
  std::vector<ShownShares> all(static_cast<std::size_t>(shows.shape(0)));
  for (std::size_t view = 0; view < all.size(); ++view) {
    for (std::size_t block = 0; block < blocks; ++block) {
      const double share = shows.data()[view * blocks + block];
      if (!(share >= 0.0 && share <= 1.0))
        refuse("shows", fmt::format("{} is not in [0, 1]", share));
      if (share == 0.0) continue;
      all[view].block.push_back(static_cast<std::uint32_t>(block));
      all[view].share.push_back(static_cast<float>(share));
    }
  }
  return all;
}

PlanningProblem problem_of(const Doubles& cells, const Doubles& shows, const Doubles& places,
                           const Doubles& travel_s, double scan_s, double time_left_s,
                           const std::optional<std::vector<double>>& home_s) {
  PlanningProblem problem;
  problem.cells = cells_of(cells);
  problem.shows = shows_of(shows, problem.cells.size());
  const Eigen::MatrixXd rows = rows_of(places, 2, "places");
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
    problem.place_m.emplace_back(rows(i, 0), rows(i, 1));
  problem.travel_s = times_of(travel_s, "travel_s");
  problem.scan_s = at_least_0(scan_s, "scan_s");
  problem.left.time_s = at_least_0(time_left_s, "time_left_s");
  problem.home_s = home_s.value_or(std::vector<double>{});
  for (const double home : problem.home_s) at_least_0(home, "home_s");
  const std::size_t n = problem.views();
  if (problem.place_m.size() != n || static_cast<std::size_t>(problem.travel_s.cols()) != n ||
      (!problem.home_s.empty() && problem.home_s.size() != n + 1)) {
    refuse("shows, places, travel_s, home_s", "not of the same number of views");
  }
  return problem;
}

PlanningProblem problem_on_map(const OccupancyGrid& grid, const Doubles& rows,
                               const PathField& ways, const py::object& places,
                               const py::object& sensor, const py::object& gain, double speed_m_s,
                               double scan_s, double time_left_s, double block_m, int threads) {
  require_threads(threads);
  require_cells(grid, "grid");
  auto views = views_of(rows);
  if (static_cast<Eigen::Index>(views.size()) > kMaxViews) refuse("views", "more than 2000");
  const Eigen::MatrixXd given =
      places.is_none() ? Eigen::MatrixXd() : rows_of(py::cast<Doubles>(places), 2, "places");
  if (!places.is_none() && given.rows() != static_cast<Eigen::Index>(views.size())) {
    refuse("places", fmt::format("{} of {} views", given.rows(), views.size()));
  }
  std::vector<Eigen::Vector2d> places_m;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    places_m.emplace_back(places.is_none()
                              ? Eigen::Vector2d(views[i].T_world_sensor.translation().head<2>())
                              : Eigen::Vector2d(given.row(row).transpose()));
    views[i].reachable = ways.reachable(places_m.back());
  }
  if (!(speed_m_s > 0.0 && speed_m_s < 1e6)) refuse("speed_m_s", "not above 0");
  const Gain wanted = options_of<Gain>(gain, "gain", BeerLambertGain{});
  if (std::holds_alternative<AdaptiveGain>(wanted))
    refuse("gain", "adaptive learns on a run; take beer_lambert");
  const ViewPlanningInput input{
      .map = {grid},
      .gain = wanted,
      .candidates = views,
      .places_m = places_m,
      .field_of_view = options_of<FieldOfView>(sensor, "sensor", kRgbdCamera),
      .paths = ways,
      .travel_time = TravelTime(speed_m_s),
      .scan_s = at_least_0(scan_s, "scan_s"),
      .threads = threads};
  ViewPlanningOptions options{.block_m = block_m};
  check_options(options);
  PlanningProblem problem = interruptibly([&] { return make_view_problem(input, options); });
  problem.draw = nullptr;  // it would refer to the grid
  problem.left.time_s = at_least_0(time_left_s, "time_left_s");
  return problem;
}

std::vector<std::size_t> planned(const PlanningProblem& problem, const std::string& name,
                                 std::uint64_t seed, const py::kwargs& options) {
  const auto choice = strategy_of<ViewChoice>(name, options, "choice");
  if (!plans_views(choice)) refuse("choice", name + " does not plan ahead");
  if (std::holds_alternative<Rollout>(choice) && !problem.draw) {
    refuse("choice", "rollout draws maps, which this problem has none of");
  }
  Rng rng = choice_stream(choice, seed);
  return interruptibly([&] { return plan_views(choice, problem, rng).order; });
}

}  // namespace

void bind_tours(py::module_& module) {
  py::class_<PlanningProblem>(module, "ViewProblem",
                              "What planning several views ahead looks at.\n\n`cells` (b,): what "
                              "there is to be seen in each "
                              "block of the map; `shows` (n, b): the share of it that each view is "
                              "expected to show; `places` "
                              "(n, 2): where the base stands, world, m; `travel_s` (n + 1, n): "
                              "driving time from row to column, "
                              "the last row from where the robot is, inf where there is no way; "
                              "`home_s` (n + 1,): the way home "
                              "from each and, last, from here, which is then kept affordable.")
      .def(py::init(&problem_of), py::arg("cells"), py::arg("shows"), py::arg("places"),
           py::arg("travel_s"), py::arg("scan_s") = 0.0, py::arg("time_left_s") = kInfinity,
           py::arg("home_s") = py::none())
      .def_static("on_map", &problem_on_map, py::arg("grid"), py::arg("views"), py::arg("ways"),
                  py::arg("places") = py::none(), py::arg("sensor") = py::none(),
                  py::arg("gain") = "beer_lambert", py::arg("speed_m_s") = 0.5,
                  py::arg("scan_s") = 10.0, py::arg("time_left_s") = kInfinity,
                  py::arg("block_m") = 0.4, py::arg("threads") = 1,
                  "Of views and a sensor (as in gains()) on a grid, with the ways of a Ways. "
                  "`places` (n, 2): where "
                  "the base stands for each; default: under the sensor.")
      .def_property_readonly("views", &PlanningProblem::views, "How many views there are.")
      .def_property_readonly(
          "travel_s", [](const PlanningProblem& p) { return p.travel_s; }, "(n + 1, n) s.")
      .def_property_readonly(
          "gains",
          [](const PlanningProblem& p) {
            std::vector<double> gains;
            for (std::size_t i = 0; i < p.views(); ++i) gains.push_back(vantage::gain_of(p, i));
            return array_of(std::move(gains));
          },
          "What each view shows alone, (n,), in the unit of `cells`.");
  module.def("plan_views", &planned, py::arg("problem"), py::arg("choice") = "tour",
             py::arg("seed") = 1,
             "The views to take, in order, as indices; empty if none is affordable.\n\n`choice`: "
             "information_rate, receding_horizon, frontier_tour, two_level_tour or tour, with its "
             "options as keyword arguments; see strategies('choices').");
  module.def(
      "shortest_route",
      [](const Doubles& costs, const std::optional<std::size_t>& last) {
        const RouteCosts route{times_of(costs, "costs")};
        if (!route.cost.allFinite()) refuse("costs", "not finite");
        if (last && *last >= route.places()) refuse("last", "no place");
        return interruptibly([&] { return vantage::shortest_route(route, last); });
      },
      py::arg("costs"), py::arg("last") = py::none(),
      "The shortest way through all places: indices in order. `costs` (n + 1, n), from row to "
      "column, "
      "the last row from the start; `last`: where it ends. Exact up to 11 places. [HeldKarp1962]");
}

}  // namespace vantage::python
