/// Cluttered table tops: which objects stand where.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/geometry/pose.hpp"
#include "vantage/models/catalogue/objects/families.hpp"
#include "vantage/models/catalogue/table/open_box.hpp"

namespace vantage {

/// World frame: origin on the floor under the middle of the table.
inline constexpr double kTableTop_m = 0.72;       ///< z of the surface things stand on
inline constexpr double kTableHalf_m = 0.5;       ///< half edge of the table top
inline constexpr double kPlacementHalf_m = 0.45;  ///< objects stay within |x|, |y| of this
inline constexpr double kMaxHeight_m = 0.30;      ///< of an object or stack above the table

struct Furniture {
  enum class Kind { shelf, chair, crate };
  Kind kind = Kind::crate;
  Pose2 T_world_furniture;  ///< front along +x
};

struct TableSceneOptions {
  std::string name = "tabletop";
  std::uint64_t seed = 1;
  int objects = 15;
  int stacks = 0;
  double clearance_m = 0.012;
  std::vector<Furniture> furniture;
  void fields(auto&& f) {
    f("name", name, "name of the scene");
    f("seed", seed, "seed of the objects' shapes, choice and places");
    f("objects", objects, "number of objects on the table, stacked ones included; more clutter it",
      between(0, 30));
    f("stacks", stacks, "number of objects that stand on another one", between(0, 10));
    f("clearance_m", clearance_m,
      "least gap between the footprints of objects; higher spreads them out", between(0.0, 0.2));
  }
};

struct PlacedObject {
  ObjectSpec spec;
  GeneratedObject object;
  Pose2 T_world_object;
  double z_m = kTableTop_m;            ///< of the object's origin
  std::optional<std::size_t> support;  ///< index of the object it stands on; none: the table
};

struct TableScene {
  std::string name;
  std::uint64_t seed = 0;
  std::vector<PlacedObject> objects;
  std::vector<Furniture> furniture;
  std::vector<OpenBox> boxes = {};  ///< on the table
  double top_m = kTableTop_m;       ///< z of the surface things stand on
};

/// Objects of different categories, without footprints touching except within a stack.
/// @throws ConfigError if an option is out of range or the objects do not fit on the table.
TableScene make_table_scene(const TableSceneOptions& options);

/// The scenes checked in under models/scenes: 4, 8, 15 and 25 objects.
std::vector<TableSceneOptions> standard_scenes();

}  // namespace vantage
