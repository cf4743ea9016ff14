#include "vantage/runtime/metrics.hpp"

#include <nlohmann/json.hpp>

#include "vantage/core/hash.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

Json scan_json(const ScanRecord& scan) {
  Json predicted = Json::object();
  for (const auto& [gain, cells] : scan.predicted_cells) predicted[gain] = cells;
  return {{"time_s", scan.time_s},
          {"unobserved_cells", scan.unobserved_cells},
          {"observable_unobserved_cells", scan.observable_unobserved_cells},
          {"predicted", predicted},
          {"actual_new_cells", scan.actual_new_cells},
          {"chosen_view", scan.chosen_view},
          {"candidates", scan.candidates},
          {"plan_time_s", scan.plan_time_s},
          {"map_time_s", scan.map_time_s},
          {"scan_time_s", scan.scan_time_s},
          {"path_length_m", scan.path_length_m},
          {"pose_error_m", scan.pose_error_m},
          {"pose_error_before_registration_m", scan.pose_error_before_registration_m},
          {"yaw_error_rad", scan.yaw_error_rad},
          {"registered", scan.registered},
          {"fallback", scan.fallback},
          {"collisions", scan.collisions},
          {"precision", scan.precision},
          {"recall", scan.recall},
          {"view", view_json(scan.T_world_sensor)}};
}

/// The transmission that the gain in use assumes for an unobserved cell; null if it assumes none.
Json observability(const Episode& episode, const ClutterHazard& hazard) {
  if (std::holds_alternative<AdaptiveGain>(episode.gain)) return hazard.global_transmission();
  return std::visit(
      [](const auto& gain) -> Json {
        if constexpr (requires { gain.a; }) return gain.a;
        if constexpr (requires { gain.model.a; }) return gain.model.a;
        if constexpr (requires { gain.model.visibility.a; }) return gain.model.visibility.a;
        if constexpr (requires { gain.opacity_unobserved; }) return 1.0 - gain.opacity_unobserved;
        return nullptr;
      },
      episode.gain);
}

}  // namespace

std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json config_json(const ConfigNode& node) {
  Json json;
  for (const auto& item : node.items) json.push_back(config_json(item));
  for (const auto& [name, child] : node.entries) json[name] = config_json(child);
  if (node.kind != ConfigNode::Kind::scalar) return json;
  json = node.scalar;
  if (node.quoted) return json;
  auto number = Json::parse(node.scalar, nullptr, false);
  return number.is_discarded() ? json : number;
}

Json box_json(const Eigen::AlignedBox3d& box) {
  return {{"min_m", {box.min().x(), box.min().y(), box.min().z()}},
          {"max_m", {box.max().x(), box.max().y(), box.max().z()}}};
}

std::string_view status_name(EpisodeStatus status) {
  switch (status) {
    case EpisodeStatus::completed: return "completed";
    case EpisodeStatus::failed: return "failed";
    case EpisodeStatus::diverged: return "diverged";
    case EpisodeStatus::interrupted: return "interrupted";
  }
  return "?";
}

Json view_json(const Pose& T_world_sensor) {
  const Eigen::Vector3d p = T_world_sensor.translation();
  return {{"x_m", p.x()},
          {"y_m", p.y()},
          {"z_m", p.z()},
          {"yaw_rad", project_to_se2(T_world_sensor).yaw_rad}};
}

Json candidates_json(std::span<const Candidate> views) {
  Json list = Json::array();
  for (const Candidate& view : views) {
    Json entry = {{"id", view.id}};
    entry.update(view_json(view.T_world_sensor));
    list.push_back(entry);
  }
  return list;
}

Json summary_json(const ResolvedEpisode& resolved, const RunSummary& summary) {
  const Episode& episode = resolved.episode;
  return {{"task", episode.task},
          {"status", status_name(summary.status)},
          {"reason", summary.reason},
          {"seed", episode.seed},
          {"scene", episode.scene},
          {"method", method_name(episode)},
          {"simulated_time_s", summary.simulated_time_s},
          {"wall_time_s", summary.wall_time_s},
          {"real_time_factor",
           summary.wall_time_s > 0.0 ? summary.simulated_time_s / summary.wall_time_s : 0.0},
          {"path_length_m", summary.path_length_m},
          {"collisions", summary.collisions},
          {"state_hash", hash_text(summary.state_hash)}};
}

Json metrics_json(const ResolvedEpisode& resolved, const RunSummary& summary,
                  const MappingResult& run) {
  const Episode& episode = resolved.episode;
  const MapScore map = run.truth.score(run.grid, episode.metrics.tolerance_cells);
  Json json = summary_json(resolved, summary);
  json["observable_cells"] = run.truth.observable_cells();
  json["scans"] = Json::array();
  for (const ScanRecord& scan : run.scans) json["scans"].push_back(scan_json(scan));
  json["map"] = {{"precision", map.precision},
                 {"recall", map.recall},
                 {"tolerance_cells", episode.metrics.tolerance_cells}};
  json["observability"] = observability(episode, run.hazard);
  json["observability_per_slice"] = run.hazard.transmission_per_slice();
  json["region"] = box_json(run.grid.frame.box());
  json["candidates"] = candidates_json(run.views);
  return json;
}

}  // namespace vantage
