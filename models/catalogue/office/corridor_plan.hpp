/// Corridor loops: buildings in which a robot comes back, after a long way past walls that look
/// alike, to where it has been.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/models/catalogue/office/office_scene.hpp"
#include "vantage/models/catalogue/office/plans/floor_plan.hpp"

namespace vantage {

struct CorridorOptions {
  std::string name = "corridor_loop";
  std::uint64_t seed = 1;
  double width_m = 15.0;
  double length_m = 28.0;
  void fields(auto&& f) {
    f("name", name, "name of the scene");
    f("seed", seed, "seed of the corridor's width and of where rooms, doors and piers are");
    f("width_m", width_m, "outer edge along x; higher makes a longer loop", between(12.0, 60.0));
    f("length_m", length_m, "outer edge along y; higher makes a longer loop", between(12.0, 60.0));
  }
};

/// A corridor of 1.8 to 2.4 m goes round along the outer walls. Rooms in the middle, each with one
/// door of 1.5 m, alternate with closed shafts; few piers stand before the walls.
FloorPlan corridor_loop(const CorridorOptions& options);

/// With furniture in the rooms. In the corridor stands nothing; windows and pictures are on its
/// walls.
/// @throws ConfigError if an option is out of range.
OfficeScene make_corridor_scene(const CorridorOptions& options);

/// The scenes checked in under models/scenes: corridor_{loop,long}_1, corridor_loop_c_1 and
/// corridor_long_b_1, which options are chosen on, the latter two since a rule was changed by them;
/// corridor_{loop,long}_d_1, which results are reported on.
std::vector<CorridorOptions> corridor_scenes();

}  // namespace vantage
