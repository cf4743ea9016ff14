/// The objects that robots recognise: 326 in 51 categories, made on demand. They come in families
/// of near-duplicates, since distinct things are told apart from one view and leave nothing to
/// choose.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "vantage/models/catalogue/objects/families.hpp"

namespace vantage {

/// How a member differs from the first of its family.
enum class NearDuplicate {
  original,
  larger,      ///< all lengths by kNearDuplicateScale
  warmer,      ///< hue turned by kNearDuplicateHue_turns, brightness times kNearDuplicateBrightness
  cooler,      ///< hue turned the other way
  decal,       ///< a small image on one side
  back_label,  ///< another label at the back than the rest of the family
};
std::string_view near_duplicate_name(NearDuplicate near_duplicate);

inline constexpr double kNearDuplicateScale = 1.06;
inline constexpr double kNearDuplicateHue_turns = 0.02;
inline constexpr double kNearDuplicateBrightness = 0.96;
inline constexpr int kDatabaseObjects = 326;

struct DatabaseObject {
  std::string name;      ///< "mug_3": the category and a number from 1
  std::string category;  ///< "mug"
  std::string family;    ///< "mug_a"; its members are near-duplicates
  NearDuplicate near_duplicate = NearDuplicate::original;
  bool labelled = false;   ///< the family wears a label at the back
  std::uint64_t seed = 0;  ///< of the family's shape and texture
};

/// All kDatabaseObjects, whole families together and every category's first family before any
/// second one: the first n are a database of n objects. Yaw 0 is the object as generated.
std::vector<DatabaseObject> object_database(std::uint64_t seed = 1);

/// Mesh and texture in memory; takes some milliseconds. The origin is below the middle of the
/// bounding box.
/// @throws ConfigError if there is no such category.
GeneratedObject generate(const DatabaseObject& object);

}  // namespace vantage
