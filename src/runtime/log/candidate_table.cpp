#include "vantage/runtime/log/candidate_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vantage {

std::string pose_columns(const Pose& T_world_sensor) {
  const Eigen::Vector3d p = T_world_sensor.translation();
  const Eigen::Vector3d forward = T_world_sensor.linear().col(0);
  // Of the left axis, which stays level, for views straight up or down as well.
  const Eigen::Vector3d left = T_world_sensor.linear().col(1);
  return fmt::format("{},{},{},{},{}", p.x(), p.y(), p.z(), std::atan2(0.0 - left.x(), left.y()),
                     std::asin(std::clamp(0.0 - forward.z(), -1.0, 1.0)));
}

std::string view_columns(const ViewOption& view) {
  return fmt::format("{},{},{},{},{}", pose_columns(view.T_world_sensor), view.gain, view.gain_unit,
                     view.predicted_cells ? fmt::format("{}", *view.predicted_cells) : "",
                     std::isfinite(view.way_m) ? fmt::format("{}", view.way_m) : "");
}

CandidateTable::CandidateTable(const std::filesystem::path& run_dir, std::string_view columns)
    : file_(run_dir / "candidates.csv") {
  file_.write(fmt::format("decision,candidate,{},chosen\n", columns));
}

void CandidateTable::add_decision(std::span<const CandidateRow> rows, std::size_t chosen) {
  ++decisions_;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    file_.write(
        fmt::format("{},{},{},{}\n", decisions_, rows[i].id, rows[i].columns, i == chosen ? 1 : 0));
  }
}

}  // namespace vantage
