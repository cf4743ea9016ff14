/// Pieces of office furniture as textured meshes.
#pragma once

#include <string_view>

#include "vantage/models/catalogue/shapes/footprint.hpp"
#include "vantage/models/catalogue/shapes/mesh.hpp"

namespace vantage {

enum class OfficeItem {
  desk,
  desk_pair,  ///< back to back, with a screen between them
  office_chair,
  visitor_chair,
  shelf,
  sideboard,
  filing_cabinet,
  sofa,
  armchair,
  coffee_table,
  meeting_set,  ///< a table with chairs round it
  partition,
  plant,
  waste_bin,
  boxes,
  copier,
  coat_stand,
  window,  ///< on a wall, like the next two; its lower edge is 0.85 m above the floor
  whiteboard,
  poster,
};

inline constexpr int kVariants = 4;  ///< of each item

std::string_view item_name(OfficeItem item);
bool hangs_on_wall(OfficeItem item);

/// Frame: origin on the floor below the middle, front along +x. Solid parts overlap, so that the
/// surface is closed but not one piece. `variant` 0 .. kVariants-1 sets sizes, finishes and what
/// lies on top.
TriangleMesh make_office_item(OfficeItem item, int variant);
/// Convex outline on the floor, computed once.
const Outline& item_footprint(OfficeItem item, int variant);

namespace office {  // one maker a kind, in office_desks.cpp, office_seats.cpp, office_storage.cpp
TriangleMesh desk(int variant);
TriangleMesh desk_pair(int variant);
TriangleMesh meeting_set(int variant);
TriangleMesh coffee_table(int variant);
TriangleMesh partition(int variant);
TriangleMesh office_chair(int variant);
TriangleMesh visitor_chair(int variant);
TriangleMesh sofa(double width_m, int seats, int variant);
TriangleMesh shelf(int variant);
TriangleMesh sideboard(int variant);
TriangleMesh filing_cabinet(int variant);
TriangleMesh copier(int variant);
TriangleMesh boxes(int variant);
TriangleMesh plant(int variant);
TriangleMesh waste_bin(int variant);
TriangleMesh coat_stand(int variant);
TriangleMesh window(int variant);
TriangleMesh whiteboard(int variant);
TriangleMesh poster(int variant);
}  // namespace office

}  // namespace vantage
