/// Furnished offices: what stands where.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/models/catalogue/office/clearance_map.hpp"
#include "vantage/models/catalogue/office/office_furniture.hpp"
#include "vantage/models/catalogue/office/plans/floor_plan.hpp"

namespace vantage {

inline constexpr double kDriveRadius_m = 0.62;  ///< a disc of this radius gets into every room
inline constexpr double kStartClearance_m = 0.6;
inline constexpr int kClutterLevels = 4;

struct OfficeOptions {
  std::string name = "office";
  std::uint64_t seed = 1;
  bool large = false;
  int clutter = 1;
  double doors_m = 0.0;
  std::uint64_t walls = 0;
  void fields(auto&& f) {
    f("name", name, "name of the scene");
    f("seed", seed, "seed of which furniture stands where");
    f("large", large, "true: the floor plan of 20 x 25 m; false: that of 15 x 10 m");
    f("clutter", clutter, "level of clutter; each level has everything of those below it and more",
      between(1, kClutterLevels));
    f("doors_m", doors_m,
      "width of the doors of six rooms off a corridor, 13 x 9.6 m; 0: the plan that `large` says",
      between(0.0, 1.2));
    f("walls", walls,
      "seed of where the inner walls, doors, pillars and starts are; 0: as planned");
  }
};

struct PlacedItem {
  OfficeItem item = OfficeItem::desk;
  int variant = 0;
  Pose2 T_world_item;
};

FloorPlan floor_plan(const OfficeOptions& options);

struct OfficeScene {
  std::string name;
  std::uint64_t seed = 0;
  int clutter = 1;
  FloorPlan plan;
  std::vector<PlacedItem> furniture;
};

/// Furniture keeps the doors free. Every room stays within reach of every start for a disc of
/// kDriveRadius_m (with narrow doors, each room from its doors), and the starts keep
/// kStartClearance_m. Chairs may stand partly under tables.
/// @throws ConfigError if an option is out of range.
OfficeScene make_office_scene(const OfficeOptions& options);
/// The same in walls of one's own; `options.large` is not asked.
OfficeScene furnished(const OfficeOptions& options, const FloorPlan& plan);

/// What bounds the robot's way: walls, pillars, door posts, furniture.
std::vector<Outline> obstacles(const OfficeScene& scene);

}  // namespace vantage
