#include "bench/cost_figures.hpp"

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
constexpr double kMetresPerCm = 0.01;

struct Over {
  int first;
  int last;
  int step;
};

FigureSeries curve(const std::string& name, std::size_t style, const Over& over,
                   const std::function<double(double)>& cost) {
  FigureSeries series{name, style, {}};
  for (int x = over.first; x <= over.last; x += over.step) {
    const double y = cost(x);
    series.points.push_back({static_cast<double>(x), 1, y, {y, y}});
  }
  return series;
}

Figure obstacle_figure() {
  constexpr double kSpeed_m_s = 0.5;
  constexpr double kColumn_m = 0.3;
  const double zero_from_m = kDefault.epsilon_m + kDefault.body_radius_m;
  const Over over{-30, 150, 2};
  const auto to_surface = [](double cm) {
    return obstacle_cost(kDefault, kMetresPerCm * cm, kSpeed_m_s);
  };
  const auto to_middle = [](double cm) {
    return obstacle_cost(kDefault, kColumn_m + kMetresPerCm * cm, kSpeed_m_s);
  };
  return {.name = "cost_obstacle",
          .title = "c_o beside a column of 0.3 m at 0.5 m/s",
          .x_label = "cm from its surface",
          .y_label = "c_o, m^2/s",
          .panels = {{"",
                      {curve("distance to the surface", 0, over, to_surface),
                       curve("as printed: to the middle", 1, over, to_middle)}}},
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
          .x_label = "bearing, deg",
          .y_label = "c_v",
          .panels = {{"",
                      {curve("in the image plane, and the bearing", 0, over, of_bearing(kDefault)),
                       curve("as printed", 1, over, of_bearing(kLiteral))}}},
          .note = fmt::format("The frame ends at {:.1f} deg; beyond, the bearing leads back to it.",
                              0.5 * FlightCamera{}.horizontal_fov_rad * 180.0 / std::numbers::pi)};
}

Figure recognition_figure() {
  const ObservationTarget target{.p_world_view_m = {1.3, 0.0, 0.0}, .entropy_nats = 1.0};
  const Over over{-200, 300, 5};
  const auto on_the_line = [&target](const FlightCostOptions& options) {
    return [&target, &options](double cm) {
      return recognition_cost(options, target, {kMetresPerCm * cm, 0.0, 0.0});
    };
  };
  return {.name = "cost_recognition",
          .title = "c_r through the object and its view at 1.3 m",
          .x_label = "cm from the object, towards the view",
          .y_label = "c_r, m",
          .panels = {{"",
                      {curve("to the view and the ray through it", 0, over, on_the_line(kDefault)),
                       curve("as printed: to the object and the line", 1, over,
                             on_the_line(kLiteral))}}},
          .note = "As printed it is least inside the object."};
}

Figure information_figure() {
  constexpr double kNatsPerStep = 0.01;
  const auto of_entropy = [](double steps) {
    return information_cost(kDefault, kNatsPerStep * steps);
  };
  return {.name = "cost_information",
          .title = fmt::format("c_i, tau = {} nats", kDefault.tau_nats),
          .x_label = "entropy, hundredths of a nat",
          .y_label = "c_i",
          .panels = {{"", {curve("as printed", 0, {0, 40, 1}, of_entropy)}}},
          .note = "What is known is worth no detour."};
}

}  // namespace

std::vector<Figure> cost_figures() {
  return {obstacle_figure(), centre_figure(), recognition_figure(), information_figure()};
}

}  // namespace vantage::bench
