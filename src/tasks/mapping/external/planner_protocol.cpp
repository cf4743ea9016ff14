#include "vantage/tasks/mapping/external/planner_protocol.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

#include "vantage/runtime/process/line_buffer.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;
constexpr std::string_view kProtocol = "vantage-planner";

/// Infinite is null.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json pose_json(const Pose2& pose) { return {pose.x_m, pose.y_m, pose.yaw_rad}; }

/// x, y, z, yaw, pitch; positive pitch looks down.
Json sensor_json(const Pose& T_world_sensor) {
  const Eigen::Vector3d p = T_world_sensor.translation();
  const Eigen::Vector3d forward = T_world_sensor.linear().col(0);
  return {p.x(), p.y(), p.z(), std::atan2(forward.y(), forward.x()),
          std::atan2(-forward.z(), forward.head<2>().norm())};
}

Json field_json(const FieldOfView& field) {
  return {{"panorama", field.panorama},
          {"half_width_rad", field.panorama ? std::numbers::pi : field.half_width_rad},
          {"tilt_min_rad", field.tilt_min_rad},
          {"tilt_max_rad", field.tilt_max_rad},
          {"range_min_m", field.range_min_m},
          {"range_max_m", field.range_max_m}};
}

Json candidate_json(const DecisionRequest& request, std::size_t i) {
  const Candidate& view = request.candidates[i];
  Json json = {{"view", i},
               {"sensor", sensor_json(view.T_world_sensor)},
               {"gain", view.gain_bits},
               {"path_length_m", number(view.path_length_m)},
               {"travel_s", number(request.travel_s[i])},
               {"reachable", view.reachable},
               {"exhausted", view.exhausted}};
  if (i < request.interval_cells.size()) json["interval"] = request.interval_cells[i];
  return json;
}

/// One JSON object in a line. @throws BadDecision
Json object_in(std::string_view line) {
  Json json = Json::parse(line, nullptr, false);
  if (json.is_object()) return json;
  throw BadDecision(fmt::format("expected one JSON object in a line, got '{}'", printable(line)));
}

std::size_t view_in(const Json& view, std::string_view line) {
  if (view.is_number_unsigned()) return view.get<std::size_t>();
  throw BadDecision(fmt::format("\"view\" is no whole number from 0 on: '{}'", printable(line)));
}

Pose2 pose_in(const Json& pose, std::string_view line) {
  const auto is_number = [](const Json& value) { return value.is_number(); };
  if (pose.is_array() && pose.size() == 3 && std::ranges::all_of(pose, is_number)) {
    return {pose[0].get<double>(), pose[1].get<double>(), pose[2].get<double>()};
  }
  throw BadDecision(fmt::format("\"pose\" is not [x, y, yaw]: '{}'", printable(line)));
}

}  // namespace

std::string introduction_line(const PlannerIntroduction& introduction) {
  return Json({{"type", "hello"},
               {"protocol", kProtocol},
               {"version", kPlannerProtocol},
               {"task", introduction.task},
               {"seed", introduction.seed},
               {"scans", introduction.scans},
               {"time_s", number(introduction.budget.time_s)},
               {"energy_j", number(introduction.budget.energy_j)},
               {"gain", introduction.gain},
               {"gain_unit", introduction.gain_unit}})
      .dump();
}

std::string read_introduction(std::string_view line) {
  const Json json = object_in(line);
  const Json version = json.value("version", Json());
  if (json.value("protocol", Json()) != kProtocol || !version.is_number_integer()) {
    throw BadDecision(
        fmt::format("its first line is not {{\"protocol\": \"{}\", \"version\": {}}}: '{}'",
                    kProtocol, kPlannerProtocol, printable(line)));
  }
  if (version != kPlannerProtocol) {
    throw BadDecision(fmt::format("it speaks version {} of the protocol, this is version {}",
                                  version.dump(), kPlannerProtocol));
  }
  const Json name = json.value("name", Json());
  return name.is_string() ? printable(name.get<std::string>()) : std::string();
}

std::string request_line(const DecisionRequest& request, std::size_t decision, const Json& grids) {
  const MapSituation& now = request.situation;
  Json json = {{"type", "decide"},
               {"decision", decision},
               {"scans", now.scans},
               {"scans_left", now.scans_left},
               {"time_s", now.time_s},
               {"time_left_s", number(now.left.time_s)},
               {"energy_j", now.energy_j},
               {"energy_left_j", number(now.left.energy_j)},
               {"scan_s", now.scan_s},
               {"pose", pose_json(now.T_world_base)},
               {"field_of_view", field_json(now.field_of_view)},
               {"candidates", Json::array()},
               {"grids", grids}};
  for (std::size_t i = 0; i < request.candidates.size(); ++i) {
    json["candidates"].push_back(candidate_json(request, i));
  }
  return json.dump();
}

OutsideDecision read_answer(std::string_view line) {
  const Json json = object_in(line);
  const bool view = json.contains("view");
  if (view == json.contains("pose")) {
    throw BadDecision(fmt::format("expected either \"view\" or \"pose\": '{}'", printable(line)));
  }
  if (view) return view_in(json["view"], line);
  return pose_in(json["pose"], line);
}

std::string end_line() { return Json({{"type", "end"}}).dump(); }

}  // namespace vantage
