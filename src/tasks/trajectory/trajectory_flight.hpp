/// The task `trajectory`: a quadrotor flies a given path, finds objects on its way and recognises
/// them.  [Potthast2016, chapter 5]
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/belief/map/flight_map.hpp"
#include "vantage/belief/objects/transition.hpp"
#include "vantage/belief/tracking/object_tracker.hpp"
#include "vantage/control/tracking_options.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/perception/search/object_search.hpp"
#include "vantage/planners/trajectory/trajectory_method.hpp"
#include "vantage/recognition/object_observations.hpp"
#include "vantage/recognition/recogniser.hpp"
#include "vantage/runtime/episode_run.hpp"
#include "vantage/runtime/measure.hpp"
#include "vantage/runtime/record_text.hpp"
#include "vantage/runtime/task_answers.hpp"
#include "vantage/sim/sensors/camera_options.hpp"
#include "vantage/sim/world/model_source.hpp"
#include "vantage/tasks/flight/object_database_options.hpp"

namespace vantage {

struct TrajectoryFlight {
  static constexpr std::string_view name = "trajectory";
  static constexpr StrategyText text{
      .summary =
          "A quadrotor flies a given path through a room, finds the objects on its way, and "
          "replans in flight so as to recognise them.",
      .source = "Potthast2016, chapter 5"};

  std::string model = "assets/models/flight.model";
  RecogniserOptions recogniser{.features = {"colour", "bounding_box", "sift"}};
  TransitionModel transition = RigidTransition{};
  ObjectDatabaseOptions database;
  double placement_m = 0.02;
  TrajectoryMethod method = Stomp{};
  FlightPlannerOptions planner;
  int horizon = 10;
  double latency_s = 0.1;
  double image_rate_hz = 10.0;
  double camera_pitch_rad = 0.35;
  ObservationOptions observations;
  ObjectSearchOptions search;
  ObjectTrackerOptions tracker;
  FlightMapOptions map;
  TrajectoryTrackingOptions tracking;
  RgbdOptions camera;
  ExposureOptions exposure;
  double colour_noise = 4.0;
  void fields(auto&& f) {
    f("model", model, "file of the recognition model, written by `vantage train`");
    f("recogniser", recogniser,
      "which features of the model are used, and how its variances are estimated");
    f("transition", transition,
      "how the belief about an object changes between views of it from different bearings");
    f("database", database, "objects that may stand in the scene");
    f("placement_m", placement_m,
      "greatest random offset of an object from the middle of its support surface",
      between(0.0, 0.1));
    f("method", method,
      "how the next waypoints are planned: by a simple rule or a trajectory optimiser");
    f("planner", planner,
      "what all methods plan by: cost, views, clearance, deviation from the given path");
    f("horizon", horizon,
      "number of waypoints that are planned at once (K); higher looks farther ahead and takes "
      "longer",
      between(3, 100));
    f("latency_s", latency_s,
      "simulated time from reaching a waypoint to flying the plan made there, however long "
      "planning really took",
      between(0.0, 100.0));
    f("image_rate_hz", image_rate_hz,
      "images taken per second of flight; higher gives more detections and takes longer",
      between(0.1, 100.0));
    f("camera_pitch_rad", camera_pitch_rad,
      "tilt of the camera below the body's horizon, fixed during the flight; higher looks down "
      "more steeply",
      between(0.0, 1.0471975511965976));
    f("observations", observations, "which detections are taken as observations of an object");
    f("search", search, "how objects on support surfaces are found in depth images");
    f("tracker", tracker, "how detections are associated to objects");
    f("map", map, "occupancy map of the obstacles on the way");
    f("tracking", tracking,
      "how trajectories are flown: controller, limits, pose errors, gusts; what tells when a goal "
      "is "
      "reached has no effect, as the flight does not stop");
    f("camera", camera, "RGB-D camera of the vehicle");
    f("exposure", exposure, "exposure of the colour images, which blurs them in motion");
    f("colour_noise", colour_noise,
      "standard deviation of the noise on colour values of 0 to 255; higher is noisier",
      between(0.0, 100.0));
  }

  [[nodiscard]] std::string method_name() const;
  void check_with(const EpisodeOptions& episode) const;
  void find_files(const std::filesystem::path& base);
  [[nodiscard]] std::vector<InputFile> inputs() const;
  [[nodiscard]] ModelSource model_source(const EpisodeSetup& setup) const;
  [[nodiscard]] TaskExtent extent(const EpisodeSetup& setup) const;
  [[nodiscard]] static WindowContent window();
  /// With the map of the flight, whose extent is that of the path.
  [[nodiscard]] WindowContent window(const EpisodeSetup& setup) const;
  [[nodiscard]] static ReportSections report();
  [[nodiscard]] static std::string_view metrics_task() { return name; }
  [[nodiscard]] static std::string_view robot_kind() { return QuadrotorDescription::name; }
  [[nodiscard]] static Measures measures();
  [[nodiscard]] static RecordTexts records();
  [[nodiscard]] static std::string outcome(const nlohmann::ordered_json& metrics);
  /// @throws ConfigError or InputError if the episode cannot begin.
  void require_start(const EpisodeSetup& setup) const;
  RunOutcome run(const RunRequest& request) const;
};

}  // namespace vantage
