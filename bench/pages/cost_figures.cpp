#include "bench/pages/cost_figures.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "vantage/planners/trajectory/flight_cost.hpp"

namespace vantage::bench {
namespace {

const FlightCostOptions kDefault;
const FlightCostOptions kLiteral{.literal = true};

/// Whole numbers of `unit`.
struct Over {
  int first;
  int last;
  int step;
  double unit = 1.0;
};

FigureSeries curve(const std::string& name, std::size_t style, const Over& over,
                   const std::function<double(double)>& cost) {
  FigureSeries series{name, style, {}};
  for (int i = over.first; i <= over.last; i += over.step) {
    const double x = over.unit * i;
    const double y = cost(x);
    series.points.push_back({x, 1, 1, y, {y, y}});
  }
  return series;
}

Figure obstacle_figure() {
  constexpr double kSpeed_m_s = 0.5;
  constexpr double kColumn_m = 0.3;
  const double zero_from_m = kDefault.epsilon_m + kDefault.body_radius_m;
  const Over over{-30, 150, 2, 0.01};
  const auto to_surface = [](double m) { return obstacle_cost(kDefault, m, kSpeed_m_s); };
  const auto to_middle = [](double m) {
    return obstacle_cost(kDefault, kColumn_m + m, kSpeed_m_s);
  };
  return {.name = "cost_obstacle",
          .title = "c_o beside a column of 0.3 m at 0.5 m/s",
          .x_label = "distance from its surface, m",
          .y_label = "c_o, m^2/s",
          .panels = {{"",
                      {curve("distance to the surface", 0, over, to_surface),
                       curve("as printed: to the middle", 1, over, to_middle)}}},
          .least_x_step = 0.1,
          .note = fmt::format("Zero from a distance of epsilon + r_b = {} m on.", zero_from_m)};
}

Figure centre_figure() {
  const Over over{-180, 180, 2};
  const auto of_bearing = [](const FlightCostOptions& options) {
    return [&options](double deg) {
      const double rad = deg * std::numbers::pi / 180.0;
      return centre_cost(options, FlightCamera{}, Eigen::Vector4d::Zero(),
                         {2.0 * std::cos(rad), 2.0 * std::sin(rad), 0.0});
    };
  };
  return {.name = "cost_centre",
          .title = "c_v of a target beside the optical axis",
          .x_label = "bearing of the target, deg",
          .y_label = "c_v, no unit",
          .panels = {{"",
                      {curve("in the image plane, and the bearing", 0, over, of_bearing(kDefault)),
                       curve("as printed", 1, over, of_bearing(kLiteral))}}},
          .note = fmt::format("The frame ends at {:.1f} deg; beyond, the bearing leads back to it.",
                              0.5 * FlightCamera{}.horizontal_fov_rad * 180.0 / std::numbers::pi)};
}

Figure recognition_figure() {
  const ObservationTarget target{.p_world_view_m = {1.3, 0.0, 0.0}, .entropy_nats = 1.0};
  const Over over{-200, 300, 5, 0.01};
  const auto on_the_line = [&target](const FlightCostOptions& options) {
    return [&target, &options](double m) {
      return recognition_cost(options, target, {m, 0.0, 0.0});
    };
  };
  return {.name = "cost_recognition",
          .title = "c_r through the object and its view at 1.3 m",
          .x_label = "distance from the object towards the view, m",
          .y_label = "c_r, m",
          .panels = {{"",
                      {curve("to the view and the ray through it", 0, over, on_the_line(kDefault)),
                       curve("as printed: to the object and the line", 1, over,
                             on_the_line(kLiteral))}}},
          .least_x_step = 0.1,
          .note = "As printed it is least inside the object."};
}

Figure information_figure() {
  const auto of_entropy = [](double nats) { return information_cost(kDefault, nats); };
  return {.name = "cost_information",
          .title = fmt::format("c_i, tau = {} nats", kDefault.tau_nats),
          .x_label = "entropy of the object, nats",
          .y_label = "c_i, no unit",
          .panels = {{"", {curve("as printed", 0, {0, 40, 1, 0.01}, of_entropy)}}},
          .least_x_step = 0.01,
          .note = "What is known is worth no detour."};
}

}  // namespace

std::vector<Figure> cost_figures() {
  return {obstacle_figure(), centre_figure(), recognition_figure(), information_figure()};
}

}  // namespace vantage::bench
