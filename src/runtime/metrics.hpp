/// metrics.json of the contract.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

#include "vantage/belief/map/clutter_hazard.hpp"
#include "vantage/runtime/episode_loop.hpp"
#include "vantage/tasks/mapping/ground_truth_map_evaluator.hpp"
#include "vantage/tasks/scenario.hpp"

namespace vantage {

struct RunSummary {
  EpisodeStatus status = EpisodeStatus::completed;
  std::string reason;  ///< why it ended early; empty when completed
  double simulated_time_s = 0.0;
  double wall_time_s = 0.0;
  double path_length_m = 0.0;
  int collisions = 0;
  std::uint64_t state_hash = 0;
};

/// Indented, with a line end; bytes that are not UTF-8 are replaced.
std::string json_text(const nlohmann::ordered_json& json);
/// Numbers and truth values as such; what was quoted is text.
nlohmann::ordered_json config_json(const ConfigNode& node);
nlohmann::ordered_json box_json(const Eigen::AlignedBox3d& box_m);  ///< min_m, max_m

std::string_view status_name(EpisodeStatus status);

/// What metrics.json says of every task.
nlohmann::ordered_json summary_json(const ResolvedEpisode& resolved, const RunSummary& summary);
/// Position and heading.
nlohmann::ordered_json view_json(const Pose& T_world_sensor);
nlohmann::ordered_json candidates_json(std::span<const Candidate> views);

/// What an episode that maps has come to.
struct MappingResult {
  const OccupancyGrid& grid;
  const ClutterHazard& hazard;
  const GroundTruthMapEvaluator& truth;
  std::span<const ScanRecord> scans;
  std::span<const Candidate> views;
};

nlohmann::ordered_json metrics_json(const ResolvedEpisode& resolved, const RunSummary& summary,
                                    const MappingResult& run);

}  // namespace vantage
