#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <cmath>

#include "python/bindings.hpp"
#include "python/kit/arrays.hpp"
#include "python/kit/calls.hpp"
#include "python/kit/options.hpp"
#include "vantage/planners/trajectory/flight_cost.hpp"
#include "vantage/planners/trajectory/optimisers/trajectory_optimiser.hpp"

namespace vantage::python {
namespace {

/// The built-in cost, with the field it refers to.
struct FlightCost {
  PathCost cost;
  std::shared_ptr<Esdf> surface;
};

FlightCost flight_cost_of(const std::shared_ptr<Esdf>& surface,
                          const std::optional<Eigen::Vector3d>& object_m,
                          const std::optional<Eigen::Vector3d>& view_m, double entropy_nats,
                          double camera_pitch_rad, const py::kwargs& options) {
  const auto weights = options_of<FlightCostOptions>(options, "");
  FlightSurroundings scene{.surface = surface.get()};
  if (object_m) {
    if (!object_m->allFinite() || (view_m && !view_m->allFinite()))
      refuse("object_m, view_m", "not finite");
    if (!(entropy_nats >= 0.0)) refuse("entropy_nats", "not at least 0");
    scene.target = ObservationTarget{.p_world_object_m = *object_m,
                                     .p_world_view_m = view_m.value_or(*object_m),
                                     .entropy_nats = entropy_nats,
                                     .flown_to = view_m.has_value()};
  }
  if (!(std::abs(camera_pitch_rad) < 1.6)) refuse("camera_pitch_rad", "not in (-1.6, 1.6)");
  FlightCamera camera;
  camera.T_body_camera = camera_ahead(camera_pitch_rad);
  return {flight_cost(weights, camera, std::move(scene)), surface};
}

/// Asks the function of Python for the cost of each point.
PathCost cost_of(const py::function& function) {
  return [&function](const Horizon& horizon, Eigen::Ref<Eigen::VectorXd> cost) {
    const py::gil_scoped_acquire locked;
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;
    const py::object answer = function(Rows(horizon.points.transpose()));
    const auto values = Doubles::ensure(answer);
    if (!values || values.ndim() != 1 || values.shape(0) != cost.size()) {
      PyErr_Clear();
      refuse("cost", fmt::format("returned no array ({},): a cost of each waypoint", cost.size()));
    }
    for (Eigen::Index i = 0; i < cost.size(); ++i) {
      cost[i] = values.data()[i];
      if (!(std::abs(cost[i]) < 1e100))
        refuse("cost", fmt::format("returned {} for waypoint {}", cost[i], i));
    }
  };
}

PathCost cost_of(const FlightCost& built_in, SignalPoll& poll) {
  return [&](const Horizon& horizon, const Eigen::Ref<Eigen::VectorXd>& cost) {
    poll();
    built_in.cost(horizon, cost);
  };
}

py::dict optimised(const Doubles& path, const py::object& cost, const std::string& method,
                   const std::optional<Eigen::Vector4d>& before,
                   const std::optional<Eigen::Vector4d>& after, std::uint64_t seed,
                   const py::kwargs& options) {
  const Eigen::MatrixXd rows = rows_of(path, 4, "path");
  constexpr Eigen::Index kMaxPoints = 1000;  // matrices of their square
  if (rows.rows() < 2 || rows.rows() > kMaxPoints) refuse("path", "not of 2 to 1000 waypoints");
  Horizon horizon;
  horizon.points = rows.transpose();
  horizon.before = before.value_or(horizon.points.col(0));
  horizon.after = after.value_or(horizon.points.col(rows.rows() - 1));
  if (!(horizon.before.cwiseAbs().maxCoeff() < 1e6 && horizon.after.cwiseAbs().maxCoeff() < 1e6)) {
    refuse("before, after", "not finite");
  }
  const auto optimiser = strategy_of<TrajectoryOptimiser>(method, options, "method");
  Rng rng = Rng::stream(seed, "optimise_trajectory");
  SignalPoll poll;
  PathCost evaluate;
  py::function function;
  if (py::isinstance<FlightCost>(cost)) {
    evaluate = cost_of(cost.cast<const FlightCost&>(), poll);
  } else if (PyCallable_Check(cost.ptr()) != 0) {
    function = py::reinterpret_borrow<py::function>(cost);
    evaluate = cost_of(function);
  } else {
    throw py::type_error("cost: neither a function nor a FlightCost");
  }
  const OptimisedHorizon best =
      without_lock([&] { return optimise(optimiser, horizon, evaluate, rng); });
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;
  return py::dict(py::arg("path") = Rows(best.points.transpose()), py::arg("cost") = best.cost,
                  py::arg("initial_cost") = best.initial_cost,
                  py::arg("evaluations") = best.evaluations);
}

}  // namespace

void bind_trajectory(py::module_& module) {
  py::class_<FlightCost>(
      module, "FlightCost",
      "Cost of a flight: near obstacles, without its target in view, far from where to look at it. "
      "[Potthast2016, (5.7)]\n\n`surface`: DistanceField or None. `object_m` (3,): what to look "
      "at, "
      "`view_m` (3,): from where (None: it is only looked at), world; `entropy_nats` of what it "
      "may be. "
      "The camera looks ahead, `camera_pitch_rad` down. Options: obstacle_weight, clearance_m, ...")
      .def(py::init(&flight_cost_of), py::arg("surface") = py::none(),
           py::arg("object_m") = py::none(), py::arg("view_m") = py::none(),
           py::arg("entropy_nats") = 1.0, py::arg("camera_pitch_rad") = 0.0);
  module.def("optimise_trajectory", &optimised, py::arg("path"), py::arg("cost"),
             py::arg("method") = "stomp", py::arg("before") = py::none(),
             py::arg("after") = py::none(), py::arg("seed") = 1,
             R"(Waypoints that cost least, smoothness included.

Parameters
----------
path : array (k, 4)
    x, y, z (m, world), yaw (rad). The first and the last stay.
cost : callable or FlightCost
    Called with waypoints (k, 4), returns the cost of each, (k,), finite. What a waypoint costs may
    depend on it and its two neighbours alone.
method : 'stomp', 'mppi', 'cem' or 'covariant_gradient'
    With its options as keyword arguments; see strategies('optimisers').
before, after : (4,)
    The waypoints flown last and next beyond; default: the ends, where it starts and stops at rest.

Returns
-------
dict : path (k, 4), cost, initial_cost, evaluations. Never worse than what was given.
)");
}

}  // namespace vantage::python
