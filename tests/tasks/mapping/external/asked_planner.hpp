/// A planner of a few lines of sh, and a situation that it is asked about.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "vantage/tasks/mapping/external/external_planner.hpp"

namespace vantage::support {

/// The first line of a planner that speaks the protocol.
inline const std::string kHello =
    R"(read hello; echo '{"protocol": "vantage-planner", "version": 1, "name": "test"}'; )";

inline ExternalChoice sh(const std::string& script, double timeout_s = 5.0) {
  return {.command = {"sh", "-c", script}, .timeout_s = timeout_s, .startup_timeout_s = timeout_s};
}

/// A robot at the origin of a free floor of 4 m; three candidates, of which the last is exhausted.
struct AskedSituation {
  OccupancyGrid grid{make_grid_frame({0, 0, 0.5}, {1, 1, 1}, {4, 3, 2})};
  BlockField transmission = uniform_field({4, 3, 2}, 0.5);
  PathField paths = [] {
    FloorMap floor({-2.0, -2.0}, 0.1, 40, 40);
    floor.log_odds.assign(floor.size(), -2.0F);
    block_box(floor, {Eigen::Vector2d(1.0, -2.0), Eigen::Vector2d(1.2, 2.0)});
    return make_path_field(floor, {0.0, 0.0, 0.0}, {.footprint_radius_m = 0.2, .margin_m = 0.05});
  }();
  Gain gain = AdaptiveGain{};
  std::vector<Candidate> candidates = [] {
    std::vector<Candidate> views(3);
    for (int i = 0; i < 3; ++i) {
      views[static_cast<std::size_t>(i)].id = i;
      views[static_cast<std::size_t>(i)].gain_bits = 10.0 * i;
      views[static_cast<std::size_t>(i)].path_length_m = 0.5 * i;
    }
    views[2].exhausted = true;
    views[1].path_length_m = std::numeric_limits<double>::infinity();
    return views;
  }();

  [[nodiscard]] DecisionRequest request() const {
    return {.situation = {.grid = grid,
                          .transmission = transmission,
                          .field_of_view = {},
                          .T_world_base = {0.0, 0.0, 0.25},
                          .scans = 1,
                          .scans_left = 4,
                          .time_s = 12.5,
                          .left = {}},
            .candidates = candidates,
            .travel_s = {0.0, std::numeric_limits<double>::infinity(), 1.0},
            .interval_cells = {{0.0, 1.0}, {5.0, 20.0}, {10.0, 40.0}},
            .gain = gain,
            .paths = paths,
            .own_choice = {}};
  }
};

}  // namespace vantage::support
