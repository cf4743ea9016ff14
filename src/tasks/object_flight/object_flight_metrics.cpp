#include "vantage/tasks/object_flight/object_flight_metrics.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

#include "vantage/runtime/json.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

/// Where the camera is, x axis level the way it looks.
Pose line_of_sight(const Pose& T_world_camera) {
  const Eigen::Vector3d ahead = T_world_camera.linear().col(2);
  return make_pose(T_world_camera.translation(), std::atan2(ahead.y(), ahead.x()));
}

Json observation_json(const ObservationRecord& record, int bins) {
  const ViewReport& report = record.report;
  Json json = {{"view_rad", report.view_rad},
               {"features", report.features},
               {"entropy_bits", report.entropy_bits},
               {"feature_time_s", report.feature_time_s},
               {"selection_time_s", report.selection_time_s},
               {"view_time_s", report.view_time_s},
               {"time_s", record.time_s},
               {"chosen_view", record.bearing_id},
               {"gain_bits", record.gain_bits},
               {"estimate", record.estimate},
               {"map_probability", record.map_probability},
               {"unknown_probability", record.unknown_probability},
               {"object_px", record.object_px},
               {"target", record.target + 1},
               {"expected_visible", record.expected_visible},
               {"seen_share", record.seen_share},
               {"not_segmented", record.not_segmented},
               {"position_error_m", record.position_error_m},
               {"angle_error_rad", record.angle_error_rad},
               {"true_yaw_rad", record.true_yaw_rad},
               {"estimated_bin", record.estimated_bin},
               {"bin_error", record.bin_error},
               {"bins", bins},
               {"collisions", record.collisions},
               {"path_length_m", record.path_length_m},
               {"leg_length_m", record.leg_length_m},
               {"view", view_json(line_of_sight(record.T_world_camera))}};
  if (record.change) {
    json["change_probability"] = record.change->probability;
    json["decision"] = to_string(record.change->verdict);
  }
  json["skipped"] = Json::array();
  for (const SkippedFeature& skipped : report.skipped) {
    json["skipped"].push_back({{"feature", skipped.feature}, {"reason", skipped.reason}});
  }
  if (const auto& flight = record.flight) {
    json["flight"] = {
        {"status", to_string(flight->status)},          {"duration_s", flight->duration_s},
        {"leg_length_m", flight->path_length_m},        {"rms_error_m", flight->rms_error_m},
        {"greatest_error_m", flight->greatest_error_m}, {"energy_j", flight->energy_J}};
  }
  return json;
}

/// Where the robot looks for the object.
Eigen::AlignedBox3d object_column(const ObjectFlight& task) {
  const double radius_m = task.segmentation.radius_m;
  const Eigen::Vector3d foot_m = task.p_world_table_m();
  const Eigen::Vector3d half_m(radius_m, radius_m, 0.0);
  const Eigen::Vector3d top_m(0.0, 0.0, task.segmentation.max_height_m);
  return {foot_m - half_m, foot_m + half_m + top_m};
}

}  // namespace

const ObservationRecord* last_view_of(const ObjectFlightParts& run, std::size_t target) {
  const ObservationRecord* last = nullptr;
  for (const ObservationRecord& record : run.records()) {
    if (record.target == target) last = &record;
  }
  return last;
}

void add_estimate(const ObjectOnTable& truth, const ObjectFlightParts& run, Json& metrics) {
  metrics["truth"] = truth.object.empty() ? Json(nullptr) : Json(truth.object);
  metrics["true_yaw_rad"] = truth.object.empty() ? Json(nullptr) : Json(truth.yaw_rad);
  const ObservationRecord* view = last_view_of(run, 0);
  if (view == nullptr) {  // ended before the first view
    for (const char* key : {"estimate", "estimated_category", "map_probability",
                            "unknown_probability", "bin_error"}) {
      metrics[key] = nullptr;
    }
    metrics["entropy_bits"] =
        state_entropy_bits(run.tour().targets().front().inquiry.recognition().belief);
    return;
  }
  const ObservationRecord& last = *view;
  metrics["estimate"] = last.estimate;
  metrics["estimated_category"] = last.category;
  metrics["entropy_bits"] = last.report.entropy_bits;
  metrics["map_probability"] = last.map_probability;
  metrics["unknown_probability"] = last.unknown_probability;
  metrics["bin_error"] = truth.object.empty() ? Json(nullptr) : Json(last.bin_error);
}

void add_observations(const ObjectFlight& task, const ObjectFlightParts& run, Json& metrics) {
  metrics["observations"] = Json::array();
  for (const ObservationRecord& record : run.records()) {
    metrics["observations"].push_back(observation_json(record, run.recogniser().states.bins));
  }
  metrics["candidates"] = candidates_json(run.places());
  metrics["region"] = box_json(object_column(task));
}

std::string text_or_nothing(const Json& metrics, const char* key) {
  return metrics[key].is_string() ? metrics[key].get<std::string>() : "nothing yet";
}

namespace {

std::optional<double> mean_of_views(const MeasuredEpisode& episode, const char* key) {
  return mean_of(step_values(episode, "observations", key));
}

}  // namespace

const ScalarMeasure kCorrect{
    {"correct", "recognised the object, or what has changed, share", Better::higher},
    [](const MeasuredEpisode& episode) { return number_of(episode, "correct"); }};
const ScalarMeasure kViews{{"views", "views taken", Better::lower},
                           [](const MeasuredEpisode& episode) -> std::optional<double> {
                             return static_cast<double>(episode.metrics.at("observations").size());
                           }};
const ScalarMeasure kStateEntropy{
    {"entropy_bits", "entropy of the state at the end, bits", Better::lower},
    [](const MeasuredEpisode& episode) { return number_of(episode, "entropy_bits"); }};
const ScalarMeasure kMapProbability{
    {"map_probability", "probability of the estimate at the end", Better::higher},
    [](const MeasuredEpisode& episode) { return number_of(episode, "map_probability"); }};
const ScalarMeasure kBinError{
    {"bin_error", "error of the pose, bins", Better::lower},
    [](const MeasuredEpisode& episode) { return number_of(episode, "bin_error"); }};
const ScalarMeasure kViewPositionError{
    {"view_position_error_m", "mean position error of a view, m", Better::lower},
    [](const MeasuredEpisode& episode) { return mean_of_views(episode, "position_error_m"); }};
const ScalarMeasure kViewAngleError{
    {"view_angle_error_rad", "mean angle error of a view, rad", Better::lower},
    [](const MeasuredEpisode& episode) { return mean_of_views(episode, "angle_error_rad"); }};
const ScalarMeasure kSeenShare{
    {"seen_share", "mean share of the target that a view shows", Better::higher},
    [](const MeasuredEpisode& episode) -> std::optional<double> {
      const Json& views = episode.metrics.at("observations");
      if (views.empty() || !views.front().contains("seen_share")) return std::nullopt;
      return mean_of_views(episode, "seen_share");
    }};
const CurveMeasure kViewEntropy{{"view_entropy_bits", "entropy of the state, bits", Better::lower},
                                [](const MeasuredEpisode& episode) {
                                  return step_values(episode, "observations", "entropy_bits");
                                }};

}  // namespace vantage
