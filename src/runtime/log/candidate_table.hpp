/// candidates.csv of a run folder: what each decision was made among.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "vantage/core/atomic_file.hpp"
#include "vantage/geometry/pose.hpp"

namespace vantage {

/// Of a sensor's pose, x forward and z up; positive pitch looks down.
inline constexpr std::string_view kPoseColumns = "x_m,y_m,z_m,yaw_rad,pitch_rad";
std::string pose_columns(const Pose& T_world_sensor);

/// Of a view that could be taken next.
inline constexpr std::string_view kViewColumns =
    "x_m,y_m,z_m,yaw_rad,pitch_rad,gain,gain_unit,predicted_cells,way_m";
struct ViewOption {
  Pose T_world_sensor = Pose::Identity();
  double gain = 0.0;
  std::string_view gain_unit;
  std::optional<double> predicted_cells;  ///< that would be new; none: the gain is none of cells
  double way_m = 0.0;                     ///< as planned; infinity: it is out of reach
};
std::string view_columns(const ViewOption& view);

struct CandidateRow {
  int id = 0;  ///< as `chosen_view` of steps.csv has it
  std::string columns;
};

/// A row a candidate: number of the decision, the first is 1 and leads to the second row of
/// steps.csv; id of the candidate; `columns`; 1 if it was chosen, else 0.
class CandidateTable {
 public:
  CandidateTable(const std::filesystem::path& run_dir, std::string_view columns);
  /// @param chosen index into `rows`
  void add_decision(std::span<const CandidateRow> rows, std::size_t chosen);
  void commit() { file_.commit(); }

 private:
  GrowingFile file_;
  std::size_t decisions_ = 0;
};

}  // namespace vantage
