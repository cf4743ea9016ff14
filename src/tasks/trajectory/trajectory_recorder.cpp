#include "vantage/tasks/trajectory/trajectory_recorder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "vantage/core/atomic_file.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/runtime/scene_file.hpp"
#include "vantage/tasks/flight/simulated_quadrotor.hpp"

namespace vantage {
namespace {

constexpr int kOnboardHeight_px = 270;

constexpr std::string_view kStepsHeader =
    "time_s,waypoint,x_m,y_m,z_m,yaw_rad,planner,plan_time_s,latency_s,late,missed,cost,"
    "planned_clearance_m,target,direction,objects,known,looks,mean_entropy_nats,clearance_m,"
    "tracking_error_m,path_length_m,collisions";

std::string steps_row(const WaypointRecord& r) {
  const Eigen::Vector3d& p = r.T_world_body.translation();
  return fmt::format(
      "{:.3f},{},{:.4f},{:.4f},{:.4f},{:.4f},{},{},{},{},{},{:.6g},{:.4f},{},{},{},"
      "{},{},{:.5f},{:.4f},{:.5f},{:.4f},{}",
      r.time_s, r.waypoint + 1, p.x(), p.y(), p.z(), project_to_se2(r.T_world_body).yaw_rad,
      r.planner, r.plan_time_s, r.latency_s, r.late, r.missed, r.cost, r.planned_clearance_m,
      r.target ? r.target->object : -1, r.target ? r.target->direction : -1, r.objects, r.known,
      r.observations, r.mean_entropy_nats, r.clearance_m, r.tracking_error_m, r.flown_m,
      r.collisions);
}

/// Pose: of the last waypoint that was planned.
constexpr std::string_view kPlanColumns =
    "planner,x_m,y_m,z_m,yaw_rad,cost,way_m,clearance_m,clear";

std::string plan_row(const CandidatePlan& plan) {
  double way_m = 0.0;
  for (Eigen::Index i = 1; i < plan.points.cols(); ++i) {
    way_m += (plan.points.col(i) - plan.points.col(i - 1)).head<3>().norm();
  }
  const Eigen::Vector4d end = plan.points.col(plan.points.cols() - 1);
  return fmt::format("{},{:.4f},{:.4f},{:.4f},{:.4f},{:.6g},{:.4f},{:.4f},{:d}", plan.planner,
                     end[0], end[1], end[2], end[3], plan.cost, way_m, plan.clearance_m,
                     plan.clear);
}

constexpr std::string_view kObservationHeader =
    "time_s,look,object,direction,bearing_rad,distance_m,elevation_rad,pixels,features,"
    "feature_time_s,entropy_nats,estimate,map_probability\n";

std::string observation_row(int object, const ObjectObservation& observation, int number) {
  return fmt::format("{:.3f},{},{},{},{:.4f},{:.4f},{:.4f},{},{},{},{:.5f},{},{:.5f}\n",
                     observation.time_s, number, object, observation.direction,
                     observation.bearing_rad, observation.distance_m, observation.elevation_rad,
                     observation.pixels, fmt::join(observation.report.features, " "),
                     observation.report.feature_time_s, observation.entropy_nats,
                     csv_field(observation.estimate), observation.map_probability);
}

/// The crop, what the mask leaves out darker.
cv::Mat crop_of(const ObjectView& view) {
  const cv::Mat rgb(view.height_px, view.width_px, CV_8UC3,
                    const_cast<std::uint8_t*>(view.rgb.data()));
  const cv::Mat mask(view.height_px, view.width_px, CV_8UC1,
                     const_cast<std::uint8_t*>(view.mask.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  cv::Mat dark = 0.35 * bgr;
  bgr.copyTo(dark, mask);
  return dark;
}

}  // namespace

TrajectoryRecorder::TrajectoryRecorder(const EpisodeRun& run, SimulatedQuadrotor& quadrotor,
                                       const RgbdOptions& camera)
    : EpisodeRecorder(run,
                      {quadrotor.world(), [&quadrotor] { return quadrotor.true_body(); },
                       [&quadrotor] { return quadrotor.estimated_body(); }, &quadrotor.faults()},
                      std::string(kStepsHeader), 1.0, kPlanColumns),
      quadrotor_(quadrotor),
      flight_(log(), directory(), !lean()),
      observations_(directory() / "looks.csv"),
      camera_(camera) {
  observations_.write(kObservationHeader);
  if (run.request().options.video) {
    onboard_ = make_offscreen_renderer(quadrotor_.world().model(),
                                       kOnboardHeight_px * camera_.width_px / camera_.height_px,
                                       kOnboardHeight_px);
  }
}

TrajectoryRecorder::~TrajectoryRecorder() = default;

void TrajectoryRecorder::set_panel(std::function<TrajectoryPanelInput()> panel) {
  log().set_panel([this, panel = std::move(panel)](cv::Size size) {
    return draw_trajectory_panel(panel(), onboard_image(), size);
  });
}

/// As the vehicle's camera sees it now, sharp.
cv::Mat TrajectoryRecorder::onboard_image() {
  RenderRequest request;
  request.depth_and_segmentation = false;
  RenderedImages drawn;
  onboard_->render(quadrotor_.world().model(), quadrotor_.world().snapshot(),
                   FixedCamera{quadrotor_.vehicle().camera_id(), camera_.fovy_rad}, request, drawn);
  const cv::Mat rgb(drawn.height_px, drawn.width_px, CV_8UC3, drawn.rgb.data());
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  return bgr;
}

void TrajectoryRecorder::waypoint(const WaypointRecord& record, int waypoints) {
  step(steps_row(record), static_cast<std::size_t>(record.waypoint) + 1,
       static_cast<double>(record.waypoint + 1) / waypoints,
       fmt::format("waypoint {} of {}: {} objects found, {} known, {} observations, {:.1f} s "
                   "simulated",
                   record.waypoint + 1, waypoints, record.objects, record.known,
                   record.observations, record.time_s));
}

void TrajectoryRecorder::decision(const std::vector<CandidatePlan>& plans, std::size_t chosen) {
  if (!keeps_candidates()) return;
  std::vector<CandidateRow> rows;
  for (const CandidatePlan& plan : plans) {
    rows.push_back({static_cast<int>(rows.size()), plan_row(plan)});
  }
  add_candidates(rows, chosen);
}

void TrajectoryRecorder::observation(int object, const ObjectObservation& observation, int number,
                                     const ObjectView& view) {
  observations_.write(observation_row(object, observation, number));
  if (lean()) return;
  const cv::Mat crop = crop_of(view);
  make_writable_directory(directory() / "views");
  write_file_with(directory() / "views" / fmt::format("look_{:03}_object_{}.png", number, object),
                  [&](const auto& part) { return cv::imwrite(part.string(), crop); });
}

void TrajectoryRecorder::commit() {
  EpisodeRecorder::commit();
  observations_.commit();
  flight_.commit();
  if (!lean()) write_scene_file(quadrotor_.world(), directory());
}

}  // namespace vantage
