/// plans.csv of a run folder: what each decision intended beyond the next view, and why.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "vantage/planners/tours/planned_tour.hpp"

namespace vantage {

struct RecordedPlan {
  std::size_t scan = 0;  ///< of steps.csv, that it leads to
  double time_s = 0.0;   ///< simulated, when it was made
  std::string gain_unit;
  PlannedTour tour;
};

/// In order of their scans, each with at least one stop.
/// @throws InputError naming file and line.
std::vector<RecordedPlan> read_plans(const std::filesystem::path& path);

/// The same for the page, with the reasons in words.
nlohmann::json plans_json(const std::filesystem::path& path);

}  // namespace vantage
