/// The options of the tasks in which a quadrotor flies round one object on a table.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "vantage/control/tracking_options.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/perception/object_segmentation.hpp"
#include "vantage/planners/objects/orbit.hpp"
#include "vantage/recognition/recogniser.hpp"
#include "vantage/recognition/recognition.hpp"
#include "vantage/runtime/episode_run.hpp"
#include "vantage/runtime/task_answers.hpp"
#include "vantage/sim/sensors/camera_options.hpp"
#include "vantage/tasks/flight/object_database_options.hpp"

namespace vantage {

/// Places to look from: level circle round the table's middle, camera on it. The keys of
/// RecognitionOptions stand beside these.
struct ObjectFlight {
  std::string model = "assets/models/flight.model";
  RecogniserOptions recogniser;
  RecognitionOptions decision;
  std::string object;
  ObjectDatabaseOptions database;
  double placement_m = 0.01;
  std::array<double, 3> table_m{0.0, 0.0, 0.72};
  double aim_height_m = 0.07;
  double distance_m = 1.0;
  double elevation_rad = 0.7853981633974483;  // 45 deg
  int bearings = 8;
  double arc_rad = 0.2;
  double settle_s = 0.5;
  TrajectoryTrackingOptions tracking;
  RgbdOptions camera;
  ExposureOptions exposure;
  double colour_noise = 4.0;
  ObjectSegmentationOptions segmentation;
  void fields(auto&& f) {
    f("model", model, "file of the recognition model, written by `vantage train`");
    f("recogniser", recogniser,
      "which features of the model are used, and how its variances are estimated");
    decision.fields(f);
    f("object", object,
      "object on the table, such as `mug_3` (`change_detection`: only in scenario `object`); "
      "empty: drawn by the seed");
    f("database", database, "objects that may stand on the table");
    f("placement_m", placement_m,
      "greatest random offset of the object from the middle of the table", between(0.0, 0.1));
    f("table_m", table_m, "middle of the table top in the world frame, which the robot knows",
      between(-1000.0, 1000.0));
    f("aim_height_m", aim_height_m, "height above the table of the point that the camera looks at",
      between(0.0, 1.0));
    f("distance_m", distance_m,
      "distance from the camera to the point that it looks at; higher makes objects smaller in the "
      "image",
      between(0.6, 3.0));
    f("elevation_rad", elevation_rad,
      "elevation of the camera above the point that it looks at; higher looks down more steeply",
      between(0.0, 1.0471975511965976));
    f("bearings", bearings,
      "number of viewpoints, evenly spaced round the object, the first one drawn by the seed; more "
      "take longer to choose from",
      between(2, 360));
    f("arc_rad", arc_rad,
      "angle between waypoints on the way round the object; lower keeps closer to the circle",
      Range{0.0, 1.5, true});
    f("settle_s", settle_s, "hovering time before each image; higher is steadier and takes longer",
      between(0.0, 10.0));
    f("tracking", tracking,
      "how trajectories are flown: controller, limits, pose errors, gusts, tolerances");
    f("camera", camera, "RGB-D camera of the vehicle");
    f("exposure", exposure, "exposure of the colour images, which blurs them in motion");
    f("colour_noise", colour_noise,
      "standard deviation of the noise on colour values of 0 to 255; higher is noisier",
      between(0.0, 100.0));
    f("segmentation", segmentation, "how the object is cut out of an image");
  }

  [[nodiscard]] Eigen::Vector3d p_world_table_m() const {
    return {table_m[0], table_m[1], table_m[2]};
  }
  /// The camera, from all bearings.
  [[nodiscard]] Orbit orbit() const { return orbit_round(p_world_table_m()); }
  /// The same round what stands at a place on the table.
  [[nodiscard]] Orbit orbit_round(const Eigen::Vector3d& p_world_place_m) const;

  // What both tasks answer alike, see task.hpp.
  [[nodiscard]] std::string method_name() const;
  void check_with(const EpisodeOptions& episode) const;
  void find_files(const std::filesystem::path& base);
  [[nodiscard]] std::vector<InputFile> inputs() const;
  [[nodiscard]] TaskExtent extent(const EpisodeSetup& setup) const;
  [[nodiscard]] static WindowContent window();
};

}  // namespace vantage
