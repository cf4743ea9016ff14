/// What mapping tasks measure: metrics.json as the contract has it, and the line of its
/// outcome.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>

#include "vantage/belief/map/clutter_hazard.hpp"
#include "vantage/planners/candidate.hpp"
#include "vantage/tasks/mapping/ground_truth_map_evaluator.hpp"
#include "vantage/tasks/mapping/localisation_summary.hpp"
#include "vantage/tasks/mapping/mapping_options.hpp"

namespace vantage {

/// What an episode that maps has come to.
struct MappingResult {
  const OccupancyGrid& grid;
  const ClutterHazard& hazard;
  const GroundTruthMapEvaluator& evaluator;
  std::span<const ScanRecord> scans;
  std::span<const Candidate> views;
  const LocalisationSummary& localisation;
};

void add_mapping_metrics(const MappingOptions& options, const MappingResult& run,
                         nlohmann::ordered_json& metrics);

std::string mapping_outcome(const nlohmann::ordered_json& metrics);

}  // namespace vantage
