/// The options that all mapping tasks have.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "vantage/belief/map/clutter_hazard.hpp"
#include "vantage/belief/map/floor_map.hpp"
#include "vantage/belief/map/free_space.hpp"
#include "vantage/belief/map/hole_filling.hpp"
#include "vantage/belief/map/sensor_model.hpp"
#include "vantage/control/drive_options.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/localisation/loop_options.hpp"
#include "vantage/perception/clouds/registration.hpp"
#include "vantage/planners/choice/view_choice.hpp"
#include "vantage/planners/choice/view_problem.hpp"
#include "vantage/planners/gain.hpp"
#include "vantage/planners/navigation/path_planning.hpp"
#include "vantage/planners/views/forecast_calibration.hpp"
#include "vantage/planners/views/forecast_interval.hpp"
#include "vantage/sim/robots/odometry.hpp"
#include "vantage/sim/sensors/laser_options.hpp"
#include "vantage/tasks/mapping/driving/budget.hpp"

namespace vantage {

/// The region of interest and its grid. What is left out follows the scene before the run, see
/// follow_table(); until then, and where there is nothing to follow, it has its default.
struct MapOptions {
  static constexpr std::array<double, 3> kCentre_m{0.0, 0.0, 0.982};
  static constexpr std::array<double, 3> kSize_m{1.0, 1.0, 0.504};
  static constexpr std::array<int, 3> kCells{129, 129, 65};

  std::optional<std::array<double, 3>> centre_m;
  std::optional<std::array<double, 3>> size_m;
  std::optional<std::array<int, 3>> cells;
  void fields(auto&& f) {
    f("centre_m", centre_m,
      "centre of the mapped region in the world frame; auto: over the table of the scene, the "
      "lower face 1 cm above its top",
      between(-1000.0, 1000.0));
    f("size_m", size_m,
      "edge lengths of the mapped region along x, y and z; auto, where centre_m is too: the "
      "table's extent, 0.504 m high",
      Range{0.0, 1000.0, true});
    f("cells", cells,
      "number of cells along x, y and z; more resolve finer and take time in proportion; auto, "
      "where size_m is too: of 7.75 mm",
      between(1, 4096));
  }
  void check() const;  ///< at most 2^26 cells
  void fill_in();      ///< what is still open gets its default
  [[nodiscard]] double count() const;
  [[nodiscard]] Eigen::Vector3d centre() const {
    return Eigen::Vector3d(centre_m.value_or(kCentre_m).data());
  }
  [[nodiscard]] Eigen::Vector3d size() const {
    return Eigen::Vector3d(size_m.value_or(kSize_m).data());
  }
  [[nodiscard]] GridFrame frame() const {
    return make_grid_frame(centre_m.value_or(kCentre_m), size_m.value_or(kSize_m),
                           cells.value_or(kCells));
  }
};

struct MetricsOptions {
  int tolerance_cells = 1;
  double pose_spacing_m = 1.0;
  double distance_band_m = 0.5;
  /// Each costs the time of one view. In an exploration, rays to every cell take seconds.
  std::vector<Gain> predictors;
  void fields(auto&& f) {
    f("tolerance_cells", tolerance_cells,
      "how far an occupied cell may be off the true surface and still count as right; higher "
      "forgives more",
      between(0, 10));
    f("pose_spacing_m", pose_spacing_m,
      "exploration: spacing of the reachable poses that decide which cells are observable; lower "
      "misses fewer and takes longer",
      between(0.05, 100.0));
    f("distance_band_m", distance_band_m,
      "width of the bands of distance from the sensor, by which predicted and actual new cells are "
      "recorded; higher gives fewer bands",
      between(0.05, 100.0));
    f("predictors", predictors,
      "gains whose predicted new cells are recorded at every scan, beside the gain in use; empty: "
      "all that predict cells (exploration: all that can be swept)");
  }
  void check() const;  ///< every predictor predicts cells
};

/// What a map is worth whose robot does not know well where it is.
struct LocalisationOptions {
  double tolerance_cells = 4.0;
  bool accept_drift = false;
  LoopOptions loops;
  double max_contradicted = 0.06;
  double max_unregistered = 0.2;
  void fields(auto&& f) {
    f("tolerance_cells", tolerance_cells,
      "how far off its place, RMS, the robot may believe what it maps to be, in the longest edge "
      "of a cell; beyond that the map is not to be trusted",
      above(0.0));
    f("accept_drift", accept_drift,
      "true: a map that is not to be trusted is a completed run all the same, with the reason; "
      "false: a failed one");
    f("loops", loops, "exploration: coming back to places of long ago, and what is made of it");
    f("max_contradicted", max_contradicted,
      "exploration: share of the planar scanner's returns whose beams go through a wall of the "
      "map, "
      "above which the map is in doubt; higher says so later",
      between(0.0, 1.0));
    f("max_unregistered", max_unregistered,
      "share of the scans that fit nowhere near where the wheels say, above which the map is in "
      "doubt; higher says so later",
      between(0.0, 1.0));
  }
};

struct MappingOptions {
  int scans = 10;
  PlanarScannerOptions base_scanner;
  OdometryOptions odometry;
  RegistrationOptions registration;
  LocalisationOptions localisation;
  MapOptions map;
  InverseSensorModel sensor_model;
  FreeSpaceUpdate free_space;
  HoleFilling hole_filling;
  ClutterHazardOptions clutter_hazard;
  ForecastCalibrationOptions forecast;
  ForecastIntervalOptions intervals;
  Gain gain = AdaptiveGain{};
  ViewChoice choice = GreedyGain{};
  ViewPlanningOptions planning;
  BudgetOptions budget;
  FloorMapOptions floor_map;
  NavigationOptions navigation;
  DriveOptions drive;
  MetricsOptions metrics;
  void fields(auto&& f) {
    f("scans", scans, "greatest number of scans of an episode, the first one included",
      between(1, 10000));
    f("base_scanner", base_scanner,
      "planar laser scanner near the floor, which the robot localises and drives by");
    f("odometry", odometry, "errors of the wheel odometry");
    f("registration", registration,
      "ICP registration of scans against earlier ones, which corrects the odometry");
    f("localisation", localisation,
      "when the pose that registration and odometry give is no longer trusted");
    f("map", map, "region and resolution of the occupancy grid");
    f("sensor_model", sensor_model,
      "inverse sensor model: what a measured point says about the cells round it");
    f("free_space", free_space, "how cells that beams have passed are updated towards free");
    f("hole_filling", hole_filling, "Markov random field that fills holes in observed surfaces");
    f("clutter_hazard", clutter_hazard,
      "how the probability that an unobserved cell stops a beam is learnt on the run");
    f("forecast", forecast, "how the learnt hazard is corrected by the robot's own forecasts");
    f("intervals", intervals, "how sure the robot is of what it forecasts a scan to show");
    f("gain", gain, "what a view is worth: how much that is new it is expected to show");
    f("choice", choice, "which of the candidate views is taken next");
    f("budget", budget, "what the episode may spend, planned for and kept by every choice");
    f("planning", planning, "what choices that plan several views ahead know of the map");
    f("floor_map", floor_map, "2-D occupancy map of the floor, which paths are planned on");
    f("navigation", navigation, "path planning on the floor map: footprint, clearance, stopping");
    f("drive", drive, "how the base follows a path, and when it has arrived or is stuck");
    f("metrics", metrics, "what is measured of an episode by ground truth");
  }

  /// "adaptive" for a greedy choice by that gain, "random" or "oracle" for a choice that looks at
  /// none, "gain_over_distance of simple" for another that does.
  [[nodiscard]] std::string method_name() const;
};

/// LocalisationOptions::tolerance_cells in metres.
double map_tolerance_m(const MappingOptions& options);

/// A gain whose prediction of newly observed cells is recorded, with its label.
struct Predictor {
  std::string label;
  Gain gain;
};
/// Those of MetricsOptions::predictors, or if there are none `defaults`; and the gain in use.
std::vector<Predictor> recorded_predictors(const MappingOptions& options,
                                           const std::vector<Gain>& defaults);

}  // namespace vantage
