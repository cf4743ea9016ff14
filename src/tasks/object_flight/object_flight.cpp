#include "vantage/tasks/object_flight/object_flight.hpp"

#include "vantage/core/names.hpp"
#include "vantage/tasks/flight/flight_world.hpp"
#include "vantage/tasks/flight/recognition_model_file.hpp"

namespace vantage {

Orbit ObjectFlight::orbit_round(const Eigen::Vector3d& p_world_place_m) const {
  const Eigen::Vector3d aim_m = p_world_place_m + Eigen::Vector3d(0.0, 0.0, aim_height_m);
  return Orbit::at_elevation(aim_m, distance_m, elevation_rad);
}

std::string ObjectFlight::method_name() const { return strategy_label(decision.views.choice); }

void ObjectFlight::check_with(const EpisodeOptions& episode) const {
  require_possible(episode.faults, {.colour = true, .rotors = true});
  require_flight_world(episode.simulation);
}

void ObjectFlight::find_files(const std::filesystem::path& base) {
  model = found_model_name(model, base);
  database.models = found_model_name(database.models, base);
}

std::vector<InputFile> ObjectFlight::inputs() const { return flight_inputs(model, database); }

TaskExtent ObjectFlight::extent(const EpisodeSetup&) const {
  return {"max_views", "views at most", static_cast<std::size_t>(decision.max_views)};
}

WindowContent ObjectFlight::window() { return {.gain_unit = "bits", .follows_height = true}; }

}  // namespace vantage
