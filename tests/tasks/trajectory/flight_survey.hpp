/// A flight along the initial path of a scene, and what a robot that knows nothing of it finds.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>

#include "vantage/belief/map/flight_map.hpp"
#include "vantage/belief/tracking/object_tracker.hpp"
#include "vantage/perception/search/object_search.hpp"
#include "vantage/sim/robots/trajectory_tracking_controller.hpp"
#include "vantage/sim/sensors/camera.hpp"
#include "vantage/sim/sensors/ground_truth.hpp"
#include "vantage/tasks/trajectory/flight_layout.hpp"
#include "vantage/tasks/trajectory/supports_ground_truth.hpp"

namespace vantage::support {

struct FlightSurveyOptions {
  std::string scene = "trajectory_1";
  std::uint64_t seed = 1;
  double speed_m_s = 0.45;
  double image_period_s = 0.5;
  double camera_pitch_rad = Quadrotor::kDefaultCameraPitch_rad;
  RgbdOptions camera = {};
  FlightMapOptions map = {};
  ObjectSearchOptions search = {};
};

inline std::filesystem::path scene_file(const std::string& name) {
  return std::filesystem::path(VANTAGE_SOURCE_DIR) / "models/scenes" / name / "scene.xml";
}

/// What is truly in an image.
struct TrueImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<int> body_ids;  ///< of each pixel
};

/// Everything about one image.
struct SurveyMoment {
  const TrueImage& truth;
  Pose T_world_camera;  ///< truth
  const std::vector<SeenObject>& seen;
  const std::vector<int>& ids;
};

inline RobotFolder robot_folder() {
  return read_robot(std::filesystem::path(VANTAGE_SOURCE_DIR) / "models/robots/quadrotor");
}

/// A world with objects drawn by a seed, and the vehicle at the start of the path.
class FlightSurvey {
 public:
  explicit FlightSurvey(const FlightSurveyOptions& options)
      : options_(options),
        path(read_flight_path(scene_file(options.scene))),
        supports_m(read_support_surfaces(scene_file(options.scene))),
        objects(draw_objects(ObjectDatabaseOptions{}, supports_m, 0.02, options.seed)),
        world({scene_file(options.scene), robot_folder().mjcf,
               object_files(ObjectDatabaseOptions{}, objects)},
              kFlightWorld),
        vehicle(world.model(), quadrotor_of(robot_folder(), "robot"), "quadrotor",
                scene_file(options.scene).string()),
        tracking((vehicle.place(world, make_pose(path.front().p_world_m, path.front().yaw_rad),
                                options.camera_pitch_rad),
                  world),
                 vehicle, TrajectoryTrackingOptions{.limits = {.speed_m_s = options.speed_m_s}},
                 Rng::stream(options.seed, "pose")),
        map(flight_region(path), options.map) {}

  /// Flies to the path's end; an image at every period.
  FlightResult fly(const std::function<void(const SurveyMoment&)>& look = {}) {
    const auto renderer =
        make_offscreen_renderer(world.model(), options_.camera.width_px, options_.camera.height_px);
    Rng noise = Rng::stream(options_.seed, "camera");
    double next_s = 0.0;
    return tracking.fly_to(std::span(path).subspan(1), [&](const TrajectoryTrackingController&) {
      if (world.time_s() < next_s) return true;
      next_s = world.time_s() + options_.image_period_s;
      const CameraImages image = rgbd(*renderer, world.model(), world.snapshot(),
                                      vehicle.camera_id(), options_.camera, noise);
      take(image, *renderer, look);
      return true;
    });
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  }

  void take(const CameraImages& images, Renderer& renderer,
            const std::function<void(const SurveyMoment&)>& look) {
    const Pose T_world_camera =
        tracking.estimate().T_world_body * vehicle.T_body_camera(vehicle.camera_pitch_rad(world));
    const auto start = Clock::now();
    map.insert(images, T_world_camera);
    map_ms += ms_since(start);
    const auto middle = Clock::now();
    const std::vector<SeenObject> seen = find_objects(images, T_world_camera, options_.search);
    search_ms += ms_since(middle);
    ++images_taken;
    const std::vector<int> ids = found.update(detections_of(seen));
    const Pose T_true =
        vantage::T_world_camera(world.model(), world.snapshot(), vehicle.camera_id());
    if (!look) return;
    const TrueImage truth{options_.camera.width_px, options_.camera.height_px,
                          body_ids(renderer, world.model(), world.snapshot(), vehicle.camera_id(),
                                   options_.camera.fovy_rad)};
    look({truth, T_true, seen, ids});
  }

  FlightSurveyOptions options_;

 public:
  std::vector<FlightWaypoint> path;
  std::vector<Eigen::Vector3d> supports_m;
  std::vector<ObjectOnSupport> objects;
  World world;
  Quadrotor vehicle;
  TrajectoryTrackingController tracking;
  FlightMap map;
  ObjectTracker found;
  double map_ms = 0.0;     ///< wall time in all
  double search_ms = 0.0;  ///< wall time in all
  int images_taken = 0;
};

/// How what was found compares with what is there.
struct SurveyScore {
  int shown = 0;                ///< times an object was well in view: see `score_of`
  int seen = 0;                 ///< of those, times it was reported
  int strangers = 0;            ///< reports of what is no object
  int whole_strangers = 0;      ///< of those, what might be observed
  int whole = 0;                ///< reports of whole objects within 2 m
  int whole_wrong = 0;          ///< of those, objects that the frame cuts
  std::vector<double> error_m;  ///< of reports of whole objects, level
  std::vector<double> overlap;  ///< of their masks within 2 m with truth: intersection over union
};

inline bool touches_border(const TrueImage& truth, int body) {
  for (int row = 0; row < truth.height_px; ++row) {
    const int step = row == 0 || row == truth.height_px - 1 ? 1 : truth.width_px - 1;
    for (int column = 0; column < truth.width_px; column += step) {
      if (truth.body_ids[static_cast<std::size_t>(row) * static_cast<std::size_t>(truth.width_px) +
                         static_cast<std::size_t>(column)] == body) {
        return true;
      }
    }
  }
  return false;
}

inline double overlap(const ObjectView& view, const TrueImage& truth, int body) {
  std::ptrdiff_t both = 0;
  std::ptrdiff_t masked = 0;
  for (int row = 0; row < view.height_px; ++row) {
    for (int column = 0; column < view.width_px; ++column) {
      if (view.mask[view.index(row, column)] == 0) continue;
      ++masked;
      const int at = (view.top_px + row) * truth.width_px + view.left_px + column;
      both += truth.body_ids[static_cast<std::size_t>(at)] == body ? 1 : 0;
    }
  }
  const auto meant = std::ranges::count(truth.body_ids, body);
  return static_cast<double>(both) / static_cast<double>(masked + meant - both);
}

/// Adds what one image tells. An object is well in view within 3 m if at least `min_pixels` show
/// it.
inline void add(SurveyScore& score, const FlightSurvey& survey, const SurveyMoment& moment,
                int min_pixels = 150) {
  std::vector<int> reported(survey.objects.size(), 0);
  const auto body_of = [&](std::size_t i) {
    return model_id(survey.world.model(), ModelObject::body, "object_" + std::to_string(i));
  };
  for (const SeenObject& seen : moment.seen) {
    bool known = false;
    for (std::size_t i = 0; i < survey.objects.size(); ++i) {
      const double off_m =
          (seen.detection.p_world_object_m - survey.objects[i].p_world_m).head<2>().norm();
      if (off_m > 0.3) continue;
      known = true;
      reported[i] = 1;
      if (!seen.detection.whole) continue;
      score.error_m.push_back(off_m);
      if (seen.detection.distance_m > 2.0) continue;
      ++score.whole;
      score.whole_wrong += touches_border(moment.truth, body_of(i)) ? 1 : 0;
      score.overlap.push_back(overlap(seen.view, moment.truth, body_of(i)));
    }
    score.strangers += known ? 0 : 1;
    score.whole_strangers += known || !seen.detection.whole ? 0 : 1;
  }
  for (std::size_t i = 0; i < survey.objects.size(); ++i) {
    const double away_m =
        (survey.objects[i].p_world_m - moment.T_world_camera.translation()).norm();
    const auto pixels = std::ranges::count(moment.truth.body_ids, body_of(i));
    if (away_m > 2.9 || pixels < min_pixels) continue;
    ++score.shown;
    score.seen += reported[i];
  }
}

}  // namespace vantage::support
