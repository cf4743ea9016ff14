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
  std::string model = "out/recognition.model";
  RecogniserOptions recogniser;
  RecognitionOptions decision;
  std::string object;
  ObjectDatabaseOptions database;
  double placement_m = 0.01;
  std::array<double, 3> table_m{0.0, 0.0, 0.72};
  double aim_height_m = 0.07;
  double distance_m = 1.0;
  double elevation_rad = 0.7853981633974483;
  int bearings = 8;
  double arc_rad = 0.2;
  double settle_s = 0.5;
  TrajectoryTrackingOptions tracking;
  RgbdOptions camera;
  ExposureOptions exposure;
  double colour_noise = 4.0;
  ObjectSegmentationOptions segmentation;
  void fields(auto&& f) {
    f("model", model, "file that `vantage train` made");
    f("recogniser", recogniser, "@@");
    decision.fields(f);
    f("object", object, "what stands on the table, \"mug_3\"; empty: drawn by the seed");
    f("database", database, "@@");
    f("placement_m", placement_m, "largest offset of the object from the table's middle",
      between(0.0, 0.1));
    f("table_m", table_m, "middle of the table top, world; known", between(-1000.0, 1000.0));
    f("aim_height_m", aim_height_m, "of what the camera looks at, over the table",
      between(0.0, 1.0));
    f("distance_m", distance_m, "camera to there; higher sees smaller objects", between(0.6, 3.0));
    f("elevation_rad", elevation_rad, "of the line of sight (45 deg)",
      between(0.0, 1.0471975511965976));
    f("bearings", bearings, "evenly round the object; the first is drawn by the seed",
      between(2, 360));
    f("arc_rad", arc_rad, "between waypoints; lower keeps closer to the circle",
      Range{0.0, 1.5, true});
    f("settle_s", settle_s, "hovering before each image", between(0.0, 10.0));
    f("tracking", tracking, "@@");
    f("camera", camera, "@@");
    f("exposure", exposure, "@@");
    f("colour_noise", colour_noise,
      "standard deviation of a colour value, of 255; higher is noisier", between(0.0, 100.0));
    f("segmentation", segmentation, "@@");
  }

  [[nodiscard]] Eigen::Vector3d p_world_table_m() const {
    return {table_m[0], table_m[1], table_m[2]};
  }
  /// The camera, from all bearings.
  [[nodiscard]] Orbit orbit() const;

  // What both tasks answer alike, see task.hpp.
  [[nodiscard]] std::string method_name() const;
  void check_with(const EpisodeOptions& episode) const;
  void find_files(const std::filesystem::path& base);
  [[nodiscard]] std::vector<InputFile> inputs() const;
  [[nodiscard]] TaskExtent extent(const EpisodeSetup& setup) const;
  [[nodiscard]] static WindowContent window();
};

}  // namespace vantage
