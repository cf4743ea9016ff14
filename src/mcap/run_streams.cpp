#include "vantage/mcap/run_streams.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

#include "vantage/mcap/messages.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/runtime/log/recording.hpp"
#include "vantage/sim/robots/robot_names.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

constexpr double kTransformPeriod_s = 0.1;
constexpr std::string_view kRobotPrefix = "robot/";

struct RobotBody {
  std::string name;
  int id = 0;
};

std::vector<RobotBody> robot_bodies(const mjModel& model) {
  std::vector<RobotBody> bodies;
  for (const std::string& name : model_names(model, ModelObject::body)) {
    if (!name.starts_with(kRobotPrefix)) continue;
    bodies.push_back({name, model_id(model, ModelObject::body, name)});
  }
  return bodies;
}

void add_trajectory(const fs::path& file, const std::string& topic, Timeline& timeline) {
  if (!fs::exists(file)) return;
  const std::size_t stream = timeline.add_stream(topic, "PoseInFrame");
  for (const TrajectorySample& sample : read_tum(file)) {
    Pose T_world_body = Pose::Identity();
    T_world_body.translate(sample.p_world_m).rotate(sample.q_world_body);
    timeline.add(stream, sample.time_s, [time_s = sample.time_s, T_world_body] {
      return pose_in_frame(time_s, T_world_body);
    });
  }
}

}  // namespace

RunToExport::RunToExport(const fs::path& run_dir)
    : directory_(run_dir),
      resolved_(load_recorded(run_dir)),
      world_(vantage::model_source(resolved_), resolved_.setup.options.simulation),
      states_(load_states(run_dir, world_)),
      map_(window(resolved_).map) {
  add_outside_effects(resolved_, world_);
  const fs::path story = run_dir / "story.bin";
  if (fs::exists(story)) events_ = read_event_log(story, map_ ? map_->size() : 0);
}

const World& RunToExport::world_at(std::size_t state) {
  if (shown_ != state) world_.set_state(states_.finite_state(state));
  shown_ = state;
  return world_;
}

std::vector<std::size_t> RunToExport::states_every(double period_s) const {
  std::vector<std::size_t> found;
  double next_s = 0.0;
  for (std::size_t i = 0; i < states_.count(); ++i) {
    if (time_s(i) + 1e-9 < next_s) continue;
    found.push_back(i);
    next_s = period_s * (std::floor(time_s(i) / period_s + 1e-6) + 1.0);
  }
  return found;
}

double RunToExport::time_s(const EpisodeEvent& event) const {
  return time_s(std::min<std::size_t>(event.tick, states_.count() - 1));
}

void add_transforms(RunToExport& run, Timeline& timeline) {
  const std::size_t stream = timeline.add_stream("/tf", "FrameTransforms");
  const auto bodies =
      std::make_shared<const std::vector<RobotBody>>(robot_bodies(run.world().model()));
  for (const std::size_t state : run.states_every(kTransformPeriod_s)) {
    timeline.add(stream, run.time_s(state), [&run, bodies, state] {
      const World& world = run.world_at(state);
      std::vector<NamedPose> frames;
      for (const RobotBody& body : *bodies) {
        frames.push_back({body.name, body_pose(world, body.id)});
      }
      return frame_transforms(run.time_s(state), frames);
    });
  }
}

void add_poses(const RunToExport& run, Timeline& timeline) {
  add_trajectory(run.directory() / "trajectory.tum", "/pose", timeline);
  add_trajectory(run.directory() / "trajectory_estimated.tum", "/pose_estimated", timeline);
}

}  // namespace vantage
