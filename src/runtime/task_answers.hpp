/// What a task answers about itself, to those who do not know which one it is.
#pragma once

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <string>

#include "vantage/geometry/grid_frame.hpp"
#include "vantage/report/report_sections.hpp"

namespace vantage {

/// How long an episode is at most, and in what.
struct TaskExtent {
  std::string key;   ///< "scans", as JSON has it
  std::string text;  ///< "scans", "views at most"
  std::size_t count = 0;
};

/// What a window draws over the scene, and where it looks.
struct WindowContent {
  Eigen::AlignedBox2d overview_m{Eigen::Vector2d(-0.5, -0.5), Eigen::Vector2d(0.5, 0.5)};
  std::optional<GridFrame> map = {};  ///< of the map that the event log tells of
  std::size_t scans = 0;              ///< planned; 0: it does not scan
  std::string gain_unit = {};
  bool follows_height = false;     ///< the camera that follows the robot goes up and down with it
  std::string step_word = "scan";  ///< what it calls one of the `scans`
};

}  // namespace vantage
