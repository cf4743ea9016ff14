/// The path as given and as flown, from above, with the directions that objects were seen from.
/// [Potthast2016, figures 5.3-5.8]
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

#include "vantage/geometry/floor_outline.hpp"

namespace vantage {

/// Of the metrics of a trajectory flight, in the room it was flown in; x and y in m, to one scale.
/// Light background, no script, no external font.
std::string flight_svg(const nlohmann::ordered_json& metrics, const std::string& title,
                       const std::vector<FloorOutline>& room);

}  // namespace vantage
