/// Which furniture a room gets, in groups that are put down together.
#pragma once

#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/models/catalogue/office/office_scene.hpp"
#include "vantage/models/catalogue/office/plans/floor_plan.hpp"

namespace vantage {

enum class Spot {
  wall,    ///< with the back to a wall
  middle,  ///< square to the walls, anywhere
  floor,   ///< anywhere, turned anyhow
};

enum class OfficeGroup {
  wall_desk,
  desk_pair,
  desk_cluster,  ///< four desks face to face
  meeting_set,
  sofa_set,
  shelf,
  sideboard,
  filing_cabinet,
  copier,
  coat_stand,
  plant,
  waste_bin,
  boxes,
  partition,
  chair,
  visitor_chair,
};

Spot spot_of(OfficeGroup group);
/// Poses are relative to the group's origin; against a wall, that is a point of the wall's foot and
/// +x points into the room.
std::vector<PlacedItem> make_group(OfficeGroup group, Rng& rng);
/// What the room gets in addition to the levels below.
std::vector<OfficeGroup> programme(const Room& room, int level);

}  // namespace vantage
