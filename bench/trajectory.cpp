// The time a replan of the next ten waypoints takes in flight: ten objects in the map, of which the
// nearest that is not yet known is the target, distances looked up in their distance field.
#include <cstdint>
#include <string>
#include <vector>

#include "bench/measures.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/planners/trajectory/replanning.hpp"
#include "vantage/planners/trajectory/simple_paths.hpp"

namespace vantage::bench {
namespace {

constexpr int kObjects = 10;
constexpr int kWaypoints = 45;
constexpr Eigen::Index kHorizon = 10;
constexpr double kSpacing_m = 0.45;
constexpr double kHeight_m = 1.2;

/// Flown ahead along x, objects in turn to its left and right.
class Flight {
 public:
  explicit Flight(Rng& rng) : waypoints_(4, kWaypoints) {
    for (Eigen::Index i = 0; i < kWaypoints; ++i) {
      waypoints_.col(i) << kSpacing_m * static_cast<double>(i), 0.0, kHeight_m, 0.0;
    }
    for (int k = 0; k < kObjects; ++k) {
      const double side = k % 2 == 0 ? 1.0 : -1.0;
      ObservedObject object;
      object.ring.p_world_object_m << 1.5 + 1.9 * k, side * rng.uniform(1.0, 1.6), kHeight_m;
      object.ring.height_m = kHeight_m;
      object.entropy_nats = 2.0;
      objects_.push_back(object);
    }
    camera_.T_body_camera = camera_ahead(0.2, {0.12, 0.0, -0.035});
  }

  /// The window of the map that moves with the vehicle.
  [[nodiscard]] Esdf surface_at(Eigen::Index waypoint) const {
    const double x = waypoints_(0, waypoint);
    const GridFrame frame = make_grid_frame({x + 2.0, 0.0, 2.0}, {10.0, 10.0, 4.0}, {100, 100, 40});
    std::vector<std::uint8_t> occupied(frame.size());
    for (std::size_t cell = 0; cell < frame.size(); ++cell) {
      const Eigen::Vector3d p = frame.centre(frame.cell(cell));
      for (const ObservedObject& object : objects_) {
        const Eigen::Vector3d from_object = p - object.ring.p_world_object_m;
        if (from_object.head<2>().norm() < 0.2 && from_object.z() < 0.25) occupied[cell] = 1;
      }
    }
    return {frame, occupied};
  }

  OptimisedHorizon plan(const TrajectoryOptimiser& optimiser, const Esdf& surface,
                        Eigen::Index waypoint) const {
    const Horizon horizon{waypoints_.col(waypoint - 1), waypoints_.middleCols(waypoint, kHorizon),
                          waypoints_.col(waypoint + kHorizon)};
    const FlightCostOptions options;
    const auto target = observation_target(objects_, waypoints_.col(waypoint).head<3>(),
                                           horizon.points, options.tau_nats);
    const PathCost cost = flight_cost(options, camera_, {.surface = &surface, .target = target});
    Rng rng(static_cast<std::uint64_t>(waypoint));
    return replan(
        optimiser, horizon, horizon.points,
        [this](const Eigen::Matrix4Xd& points) { return initial_yaw(points, objects_); }, cost,
        rng);
  }

 private:
  Eigen::Matrix4Xd waypoints_;
  std::vector<ObservedObject> objects_;
  FlightCamera camera_;
};

void run_benchmark() {
  Rng rng(1);
  const Flight flight(rng);
  std::vector<std::pair<std::string, double>> figures;
  std::vector<std::pair<std::string, double>> costs;
  std::string configuration = to_yaml(write_node(FlightCostOptions{}));
  for (const std::string_view name : strategy_names<TrajectoryOptimiser>()) {
    const auto optimiser = make_strategy<TrajectoryOptimiser>(name);
    configuration += to_yaml(write_node(optimiser));
    std::vector<double> times_ms;
    double left = 0.0;  // share of the cost that was there before
    int evaluations = 0;
    for (Eigen::Index waypoint = 1; waypoint + kHorizon < kWaypoints; waypoint += 3) {
      const Esdf surface = flight.surface_at(waypoint);
      const auto plan = flight.plan(optimiser, surface, waypoint);
      left += plan.cost / plan.initial_cost;
      evaluations = std::max(evaluations, plan.evaluations);
      times_ms.push_back(median_ms(9, [&] { flight.plan(optimiser, surface, waypoint); }));
    }
    const auto situations = static_cast<double>(times_ms.size());
    std::ranges::sort(times_ms);
    figures.emplace_back(std::string(name) + "_ms", times_ms[times_ms.size() / 2]);
    costs.emplace_back(std::string(name) + "_cost_left", left / situations);
    costs.emplace_back(std::string(name) + "_evaluations", evaluations);
  }
  figures.emplace_back("rollouts", Stomp{}.rollouts);
  figures.emplace_back("iterations", Stomp{}.iterations);
  figures.insert(figures.end(), costs.begin(), costs.end());
  const Esdf surface = flight.surface_at(1);
  std::vector<std::uint8_t> occupied(surface.frame().size());
  std::ranges::transform(surface.at_centres_m(), occupied.begin(),
                         [](float d) { return d < 0.0F ? 1 : 0; });
  figures.emplace_back("distance_field_ms", median_ms(15, [&] {
                         const Esdf again(surface.frame(), occupied);
                         expects(again.at_centres_m()[0] == surface.at_centres_m()[0], "the same");
                       }));
  print_figures("trajectory", 1, configuration, figures);
}

}  // namespace
}  // namespace vantage::bench

int main() { return vantage::bench::run_main(vantage::bench::run_benchmark); }
