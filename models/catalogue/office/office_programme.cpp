#include "vantage/models/catalogue/office/office_programme.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace vantage {
namespace {

using std::numbers::pi;

constexpr double kFromWall_m = 0.05;

int any_variant(Rng& rng) { return static_cast<int>(rng.uniform_index(kVariants)); }

/// A single piece with its back `kFromWall_m` before x = 0.
PlacedItem at_wall(OfficeItem item, int variant) {
  double back = 0.0;
  for (const auto& p : item_footprint(item, variant)) back = std::min(back, p.x());
  return {item, variant, {kFromWall_m - back, 0.0, 0.0}};
}

/// The chair of who works at the desk, pulled out and turned a little.
PlacedItem chair_at(const Pose2& T_group_desk, Rng& rng) {
  const Pose2 seat{rng.uniform(0.50, 0.66), rng.uniform(-0.15, 0.0), pi + rng.uniform(-0.5, 0.5)};
  return {OfficeItem::office_chair, any_variant(rng), compose(T_group_desk, seat)};
}

std::vector<PlacedItem> make_wall_desk(Rng& rng) {
  const PlacedItem desk = at_wall(OfficeItem::desk, any_variant(rng));
  return {desk, chair_at(desk.T_world_item, rng)};
}

/// Desks in two columns, and who works there.
std::vector<PlacedItem> make_desk_island(int rows, Rng& rng) {
  const int variant = any_variant(rng);
  std::vector<PlacedItem> items;
  for (int row = 0; row < rows; ++row) {
    const double y = 1.62 * (row - 0.5 * (rows - 1));
    items.push_back({OfficeItem::desk_pair, variant, {0.0, y, 0.0}});
    for (const double side : {1.0, -1.0}) {
      items.push_back(chair_at({side * 0.44, y, side > 0 ? 0.0 : pi}, rng));
    }
  }
  return items;
}

std::vector<PlacedItem> make_sofa_set(Rng& rng) {
  const PlacedItem sofa = at_wall(OfficeItem::sofa, any_variant(rng));
  const double x = sofa.T_world_item.x_m;
  std::vector<PlacedItem> items{sofa};
  items.push_back(
      {OfficeItem::coffee_table, any_variant(rng), {x + 0.95, rng.uniform(-0.2, 0.2), 0.0}});
  items.push_back({OfficeItem::armchair, sofa.variant, {x + 1.0, 1.15, -pi / 2 - 0.3}});
  return items;
}

/// So many of a group; `per_area` is the floor that gets one, in square metres.
void add(std::vector<OfficeGroup>& groups, OfficeGroup group, const Room& room, double per_area) {
  const int count = std::max(1, static_cast<int>(std::lround(room.area_m.volume() / per_area)));
  groups.insert(groups.end(), static_cast<std::size_t>(count), group);
}

using Wishes = std::vector<std::pair<OfficeGroup, double>>;

Wishes wishes(RoomUse use, int level) {
  using enum OfficeGroup;
  using Levels = std::array<Wishes, kClutterLevels>;
  static const Levels open_plan{
      Wishes{{wall_desk, 18}, {chair, 60}, {shelf, 70}},
      Wishes{{desk_cluster, 50}, {sideboard, 40}, {plant, 40}, {waste_bin, 40}},
      Wishes{{desk_pair, 35},
             {wall_desk, 40},
             {shelf, 40},
             {filing_cabinet, 50},
             {copier, 80},
             {coat_stand, 70}},
      Wishes{{desk_pair, 35},
             {sofa_set, 70},
             {partition, 25},
             {boxes, 10},
             {chair, 20},
             {sideboard, 60},
             {plant, 30},
             {visitor_chair, 30}}};
  static const Levels small_office{
      Wishes{{wall_desk, 16}, {shelf, 30}}, Wishes{{sideboard, 30}, {waste_bin, 20}},
      Wishes{{wall_desk, 30}, {filing_cabinet, 20}}, Wishes{{boxes, 16}, {plant, 20}}};
  static const Levels meeting{
      Wishes{{meeting_set, 40}}, Wishes{{sideboard, 30}, {plant, 25}},
      Wishes{{shelf, 18}, {visitor_chair, 16}, {waste_bin, 30}},
      Wishes{{boxes, 12}, {plant, 30}, {partition, 30}, {chair, 20}, {coat_stand, 30}}};
  static const Levels lounge{
      Wishes{{sofa_set, 30}, {sideboard, 40}}, Wishes{{plant, 20}, {waste_bin, 30}, {shelf, 40}},
      Wishes{{meeting_set, 40}, {copier, 40}, {coat_stand, 30}},
      Wishes{{sofa_set, 40}, {boxes, 12}, {visitor_chair, 12}, {partition, 30}}};
  static const Levels hallway{Wishes{{plant, 40}}, Wishes{{waste_bin, 40}}, Wishes{{sideboard, 40}},
                              Wishes{{boxes, 20}, {visitor_chair, 40}}};
  const auto i = static_cast<std::size_t>(level - 1);
  switch (use) {
    case RoomUse::open_plan: return open_plan[i];
    case RoomUse::small_office: return small_office[i];
    case RoomUse::meeting: return meeting[i];
    case RoomUse::lounge: return lounge[i];
    case RoomUse::hallway: return hallway[i];
    case RoomUse::corridor: return {};
  }
  return {};
}

}  // namespace

Spot spot_of(OfficeGroup group) {
  using enum OfficeGroup;
  switch (group) {
    case desk_pair:
    case desk_cluster:
    case meeting_set:
    case partition: return Spot::middle;
    case chair:
    case boxes:
    case visitor_chair: return Spot::floor;
    default: return Spot::wall;
  }
}

std::vector<PlacedItem> make_group(OfficeGroup group, Rng& rng) {
  using enum OfficeGroup;
  const int variant = any_variant(rng);
  switch (group) {
    case wall_desk: return make_wall_desk(rng);
    case desk_pair: return make_desk_island(1, rng);
    case desk_cluster: return make_desk_island(2, rng);
    case meeting_set: return {{OfficeItem::meeting_set, variant, {}}};
    case sofa_set: return make_sofa_set(rng);
    case shelf: return {at_wall(OfficeItem::shelf, variant)};
    case sideboard: return {at_wall(OfficeItem::sideboard, variant)};
    case filing_cabinet: return {at_wall(OfficeItem::filing_cabinet, variant)};
    case copier: return {at_wall(OfficeItem::copier, variant)};
    case coat_stand: return {at_wall(OfficeItem::coat_stand, variant)};
    case plant: return {at_wall(OfficeItem::plant, variant)};
    case waste_bin: return {at_wall(OfficeItem::waste_bin, variant)};
    case boxes: return {{OfficeItem::boxes, variant, {}}};
    case partition: return {{OfficeItem::partition, variant, {}}};
    case chair: return {{OfficeItem::office_chair, variant, {}}};
    case visitor_chair: return {{OfficeItem::visitor_chair, variant, {}}};
  }
  return {};
}

std::vector<OfficeGroup> programme(const Room& room, int level) {
  std::vector<OfficeGroup> groups;
  for (const auto& [group, per_area] : wishes(room.use, level)) add(groups, group, room, per_area);
  return groups;
}

}  // namespace vantage
