#include "vantage/models/catalogue/office/office_furniture.hpp"

#include <array>
#include <cstddef>
#include <map>
#include <utility>

#include "vantage/core/error.hpp"

namespace vantage {

std::string_view item_name(OfficeItem item) {
  constexpr std::array<std::string_view, 20> names{
      "desk",        "desk_pair",      "office_chair", "visitor_chair", "shelf",
      "sideboard",   "filing_cabinet", "sofa",         "armchair",      "coffee_table",
      "meeting_set", "partition",      "plant",        "waste_bin",     "boxes",
      "copier",      "coat_stand",     "window",       "whiteboard",    "poster"};
  return names[static_cast<std::size_t>(item)];
}

bool hangs_on_wall(OfficeItem item) {
  return item == OfficeItem::window || item == OfficeItem::whiteboard || item == OfficeItem::poster;
}

TriangleMesh make_office_item(OfficeItem item, int variant) {
  expects(variant >= 0 && variant < kVariants, "a variant of the item");
  using enum OfficeItem;
  switch (item) {
    case desk: return office::desk(variant);
    case desk_pair: return office::desk_pair(variant);
    case office_chair: return office::office_chair(variant);
    case visitor_chair: return office::visitor_chair(variant);
    case shelf: return office::shelf(variant);
    case sideboard: return office::sideboard(variant);
    case filing_cabinet: return office::filing_cabinet(variant);
    case sofa: return office::sofa(variant % 2 == 0 ? 1.9 : 1.5, variant % 2 == 0 ? 3 : 2, variant);
    case armchair: return office::sofa(0.85, 1, variant);
    case coffee_table: return office::coffee_table(variant);
    case meeting_set: return office::meeting_set(variant);
    case partition: return office::partition(variant);
    case plant: return office::plant(variant);
    case waste_bin: return office::waste_bin(variant);
    case boxes: return office::boxes(variant);
    case copier: return office::copier(variant);
    case coat_stand: return office::coat_stand(variant);
    case window: return office::window(variant);
    case whiteboard: return office::whiteboard(variant);
    case poster: return office::poster(variant);
  }
  return {};
}

const Outline& item_footprint(OfficeItem item, int variant) {
  static const auto all = [] {
    std::map<std::pair<OfficeItem, int>, Outline> outlines;
    for (int i = 0; i <= static_cast<int>(OfficeItem::poster); ++i) {
      for (int v = 0; v < kVariants; ++v) {
        const auto kind = static_cast<OfficeItem>(i);
        outlines[{kind, v}] = convex_footprint(make_office_item(kind, v));
      }
    }
    return outlines;
  }();
  return all.at({item, variant});
}

}  // namespace vantage
