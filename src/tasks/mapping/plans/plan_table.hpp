/// plans.csv of a run folder: what each decision intended beyond the next view, and why.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "vantage/core/atomic_file.hpp"
#include "vantage/planners/tours/planned_tour.hpp"
#include "vantage/runtime/record_text.hpp"

namespace vantage {

/// When a plan was made.
struct PlanMoment {
  std::size_t scan = 0;        ///< that it leads to next, the first of a run is 1
  double time_s = 0.0;         ///< simulated
  std::string_view gain_unit;  ///< of what its stops show
};

/// A row a stop of each plan.
class PlanTable {
 public:
  explicit PlanTable(const std::filesystem::path& run_dir);
  void add(const PlannedTour& tour, const PlanMoment& moment);
  void commit() { file_.commit(); }

 private:
  GrowingFile file_;
};

/// What its columns mean.
RecordTexts plan_records();

}  // namespace vantage
