/// The options that all mapping tasks have.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "vantage/belief/map/clutter_hazard.hpp"
#include "vantage/belief/map/floor_map.hpp"
#include "vantage/belief/map/free_space.hpp"
#include "vantage/belief/map/hole_filling.hpp"
#include "vantage/belief/map/sensor_model.hpp"
#include "vantage/control/drive_options.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/perception/clouds/registration.hpp"
#include "vantage/planners/choice/view_choice.hpp"
#include "vantage/planners/gain.hpp"
#include "vantage/planners/navigation/path_planning.hpp"
#include "vantage/sim/robots/odometry.hpp"
#include "vantage/sim/sensors/laser_options.hpp"

namespace vantage {

/// The region of interest and its grid.
struct MapOptions {
  std::array<double, 3> centre_m{0.0, 0.0, 0.982};
  std::array<double, 3> size_m{1.0, 1.0, 0.504};
  std::array<int, 3> cells{129, 129, 65};
  void fields(auto&& f) {
    f("centre_m", centre_m, "world", between(-1000.0, 1000.0));
    f("size_m", size_m, "m, > 0", Range{0.0, 1000.0, true});
    f("cells", cells, "finer maps cost time in proportion", between(1, 4096));
  }
  void check() const;  ///< at most 2^26 cells
  [[nodiscard]] double count() const;
  [[nodiscard]] Eigen::Vector3d centre() const { return {centre_m[0], centre_m[1], centre_m[2]}; }
  [[nodiscard]] GridFrame frame() const { return make_grid_frame(centre_m, size_m, cells); }
};

struct MetricsOptions {
  int tolerance_cells = 1;
  double pose_spacing_m = 1.0;
  std::vector<Gain> predictors;
  void fields(auto&& f) {
    f("tolerance_cells", tolerance_cells,
      "Cells an occupied cell may be off the true surface and still be right; higher forgives "
      "more.",
      between(0, 10));
    f("pose_spacing_m", pose_spacing_m,
      "Exploration: between the poses, reachable from the start, that say which cells are "
      "observable; lower misses fewer, takes longer.",
      between(0.05, 100.0));
    f("predictors", predictors,
      "Gains whose prediction of newly observed cells is recorded at every scan, beside that of "
      "the gain in use. Empty: every gain that predicts cells; in an exploration, where rays to "
      "every cell take seconds, those that can be swept. Each costs the time of one view.");
  }
  void check() const;  ///< every predictor predicts cells
};

struct MappingOptions {
  int scans = 10;
  PlanarScannerOptions base_scanner;
  OdometryOptions odometry;
  RegistrationOptions registration;
  MapOptions map;
  InverseSensorModel sensor_model;
  FreeSpaceUpdate free_space;
  HoleFilling hole_filling;
  ClutterHazardOptions clutter_hazard;
  Gain gain = AdaptiveGain{};
  ViewChoice choice = GreedyGain{};
  FloorMapOptions floor_map;
  NavigationOptions navigation;
  DriveOptions drive;
  MetricsOptions metrics;
  void fields(auto&& f) {
    f("scans", scans, "at most, the first one included", between(1, 10000));
    f("base_scanner", base_scanner, "@@");
    f("odometry", odometry, "@@");
    f("registration", registration, "@@");
    f("map", map, "@@");
    f("sensor_model", sensor_model, "@@");
    f("free_space", free_space, "@@");
    f("hole_filling", hole_filling, "@@");
    f("clutter_hazard", clutter_hazard, "@@");
    f("gain", gain, "@@");
    f("choice", choice, "@@");
    f("floor_map", floor_map, "@@");
    f("navigation", navigation, "@@");
    f("drive", drive, "@@");
    f("metrics", metrics, "@@");
  }

  /// "adaptive" for a greedy choice by that gain, "random" or "oracle" for a choice that looks at
  /// none, "gain_over_distance of simple" for another that does.
  [[nodiscard]] std::string method_name() const;
};

/// A gain whose prediction of newly observed cells is recorded, with its label.
struct Predictor {
  std::string label;
  Gain gain;
};
/// Those of MetricsOptions::predictors, or if there are none `defaults`; and the gain in use.
std::vector<Predictor> recorded_predictors(const MappingOptions& options,
                                           std::vector<Gain> defaults);

}  // namespace vantage
