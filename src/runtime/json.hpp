/// Values as the JSON of a run folder has them.
#pragma once

#include <Eigen/Geometry>
#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>

#include "vantage/core/config_node.hpp"
#include "vantage/planners/candidate.hpp"

namespace vantage {

/// Indented, with a line end; bytes that are not UTF-8 are replaced.
std::string json_text(const nlohmann::ordered_json& json);
/// The same in one line without an end.
std::string json_line(const nlohmann::ordered_json& json);
/// Numbers and truth values as such; what was quoted is text.
nlohmann::ordered_json config_json(const ConfigNode& node);
nlohmann::ordered_json box_json(const Eigen::AlignedBox3d& box_m);  ///< min_m, max_m
/// Position and heading.
nlohmann::ordered_json view_json(const Pose& T_world_sensor);
nlohmann::ordered_json candidates_json(std::span<const Candidate> views);

}  // namespace vantage
