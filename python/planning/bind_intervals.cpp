#include <fmt/format.h>

#include "python/bindings.hpp"
#include "python/kit/arrays.hpp"
#include "python/kit/options.hpp"
#include "vantage/planners/views/forecast_interval.hpp"

namespace vantage::python {
namespace {

constexpr double kMostCells = 1e30;

double cells_of(double cells, const char* argument) {
  if (!(cells >= 0.0 && cells < kMostCells))
    refuse(argument, fmt::format("{} is not a number of cells, from 0 to 1e30", cells));
  return cells;
}

const ForecastLaw& law_of(const std::string& trained) {
  if (trained == "rooms") return kForecastsInRooms;
  if (trained == "tables") return kForecastsAtTables;
  refuse("trained", fmt::format("'{}' is neither rooms nor tables", trained));
}

/// The interval, asked in the right order.
class Interval {
 public:
  Interval(const std::string& trained, const py::kwargs& options)
      : interval_(options_of<ForecastIntervalOptions>(options, "intervals"), law_of(trained)) {}

  void start(double first_view_cells) {
    if (!(first_view_cells >= 1.0)) {
      refuse("first_view_cells", fmt::format("{} is not at least 1", first_view_cells));
    }
    interval_.start(cells_of(first_view_cells, "first_view_cells"));
    started_ = true;
  }

  /// An axis of 2 behind those of the forecasts.
  [[nodiscard]] py::array_t<double> of(const Doubles& forecast_cells) const {
    require_started();
    std::vector<double> ends;
    for (py::ssize_t i = 0; i < forecast_cells.size(); ++i) {
      const CellInterval of = interval_.of(cells_of(forecast_cells.data()[i], "forecast_cells"));
      ends.insert(ends.end(), {of.low, of.high});
    }
    std::vector<py::ssize_t> shape(forecast_cells.shape(),
                                   forecast_cells.shape() + forecast_cells.ndim());
    shape.push_back(2);
    return array_of(std::move(ends), std::move(shape));
  }

  void observe(double forecast_cells, double actual_cells) {
    require_started();
    interval_.observe(cells_of(forecast_cells, "forecast_cells"),
                      cells_of(actual_cells, "actual_cells"));
  }

 private:
  void require_started() const {
    if (!started_) throw Error(ExitCode::usage, "an interval before the first view: call start()");
  }

  ForecastInterval interval_;
  bool started_ = false;
};

constexpr auto kText = R"(How far off a forecast of new cells may be.

An interval that the truth is in with the share `confidence`, whatever the errors are like, as long
as none is 1.5 times any before: adaptive conformal inference on ln(actual / forecast), which begins
with the errors of training scenes and goes on with those that observe() takes in. trained names these scenes: "rooms", of
sweeps from place to place, or "tables", of scans round a worktop. Options: confidence (0.9), rate
(0.03, how fast it widens after a miss). [Gibbs2021]
)";

}  // namespace

void bind_intervals(py::module_& module) {
  py::class_<Interval>(module, "ForecastInterval", kText)
      .def(py::init<const std::string&, const py::kwargs&>(), py::arg("trained") = "rooms")
      .def("start", &Interval::start, py::arg("first_view_cells"),
           "Call it first: the cells that an episode's first scan showed, what a view can show.")
      .def("of", &Interval::of, py::arg("forecast_cells"),
           "Low and high end, cells, of each of the forecasts: (n, 2) of (n,), (2,) of a number.")
      .def("observe", &Interval::observe, py::arg("forecast_cells"), py::arg("actual_cells"),
           "Takes in what came of a forecast.");
}

}  // namespace vantage::python
