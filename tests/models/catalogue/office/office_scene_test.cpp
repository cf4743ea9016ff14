#include "vantage/models/catalogue/office/office_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "tests/models/catalogue/scene_files.hpp"
#include "vantage/core/error.hpp"
#include "vantage/models/catalogue/office/corridor_plan.hpp"
#include "vantage/models/catalogue/office/office_list.hpp"

namespace vantage {
namespace {

bool same(const PlacedItem& a, const PlacedItem& b) {
  return a.item == b.item && a.variant == b.variant && a.T_world_item.x_m == b.T_world_item.x_m &&
         a.T_world_item.y_m == b.T_world_item.y_m &&
         a.T_world_item.yaw_rad == b.T_world_item.yaw_rad;
}

class Office : public testing::TestWithParam<OfficeOptions> {
 protected:
  /// Made once for all tests.
  static const OfficeScene& made(const std::string& name) {
    static std::map<std::string, OfficeScene> scenes;
    if (!scenes.contains(name)) {
      for (const OfficeOptions& options : office_scenes()) {
        if (options.name == name) scenes[name] = make_office_scene(options);
      }
    }
    return scenes.at(name);
  }
  const OfficeScene& scene = made(GetParam().name);
};

/// A map twice as fine as the generator's, made from the finished scene.
TEST_P(Office, EveryRoomIsReachableFromEveryStart) {
  const Eigen::AlignedBox2d area(-0.5 * scene.plan.size_m, 0.5 * scene.plan.size_m);
  ClearanceMap clearance(area, 0.05, 1.0);
  for (const Outline& outline : obstacles(scene)) clearance.add(outline);
  const auto reached =
      clearance.reachable(position(scene.plan.T_world_starts.front()), kDriveRadius_m);
  for (const Pose2& start : scene.plan.T_world_starts) {
    EXPECT_TRUE(reached[clearance.cell_at(position(start))]) << start.x_m << " " << start.y_m;
  }
  for (const Room& room : scene.plan.rooms) {
    double reached_m2 = 0.0;
    for (std::size_t cell = 0; cell < reached.size(); ++cell) {
      if (reached[cell] && room.area_m.contains(clearance.centre_m(cell)))
        reached_m2 += 0.05 * 0.05;
    }
    EXPECT_GT(reached_m2, 0.14 * room.area_m.volume()) << room.area_m.center().transpose();
  }
}

TEST_P(Office, FiveStartsAreClearAndApart) {
  const auto& starts = scene.plan.T_world_starts;
  ASSERT_EQ(starts.size(), 5U);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    for (const Outline& outline : obstacles(scene)) {
      EXPECT_GE(distance_to(outline, position(starts[i])), kStartClearance_m) << "start " << i;
    }
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT((position(starts[i]) - position(starts[j])).norm(), 3.0) << i << " and " << j;
    }
  }
}

TEST_P(Office, EverythingLiesInsideTheOffice) {
  const Eigen::Vector2d half = 0.5 * scene.plan.size_m + Eigen::Vector2d::Constant(1e-9);
  for (const Outline& outline : obstacles(scene)) {
    for (const auto& p : outline) EXPECT_TRUE((p.cwiseAbs().array() <= half.array()).all());
  }
}

TEST_P(Office, DoorWaysAreFree) {
  for (const Wall& wall : scene.plan.walls) {
    for (const auto& way : door_ways(wall, 0.9)) {
      for (const PlacedItem& placed : scene.furniture) {
        const Outline outline =
            moved(item_footprint(placed.item, placed.variant), placed.T_world_item);
        EXPECT_FALSE(too_close(outline, outline_of(way), 0.0)) << item_name(placed.item);
      }
    }
  }
}

/// Walls drawn for a scene are of that scene alone, and so is what stands between them.
TEST_P(Office, HasWhatTheLevelBelowHasAndMore) {
  if (GetParam().clutter == 1 || GetParam().walls > 0) {
    EXPECT_GE(std::ranges::count(scene.furniture, OfficeItem::desk, &PlacedItem::item), 5);
    return;
  }
  std::string name_below = GetParam().name;
  --name_below.back();
  const auto& below = made(name_below).furniture;
  ASSERT_GT(scene.furniture.size(), below.size() + 10);
  EXPECT_TRUE(std::ranges::equal(
      below,
      std::vector(scene.furniture.begin(),
                  scene.furniture.begin() + static_cast<std::ptrdiff_t>(below.size())),
      same));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Office, testing::ValuesIn(support::some_of(office_scenes(), 5)),
                         [](const auto& info) { return info.param.name; });

/// A disc gets about in each room, from its doors on; between rooms it does not.
TEST(DoorScenes, EveryRoomIsReachableFromItsDoorsAlone) {
  for (const OfficeOptions& options : door_scenes()) {
    SCOPED_TRACE(options.name);
    const OfficeScene scene = make_office_scene(options);
    const Eigen::AlignedBox2d area(-0.5 * scene.plan.size_m, 0.5 * scene.plan.size_m);
    ClearanceMap clearance(area, 0.05, 1.0);
    for (const Outline& outline : obstacles(scene)) clearance.add(outline);
    int doors = 0;
    for (const Wall& wall : scene.plan.walls) {
      for (const Opening& opening : wall.openings) EXPECT_EQ(opening.width_m, options.doors_m);
      const auto places = thresholds(wall, 0.85);
      for (std::size_t i = 0; i + 1 < places.size(); i += 2, ++doors) {
        const auto reached = clearance.reachable(places[i], kDriveRadius_m);
        EXPECT_TRUE(reached[clearance.cell_at(places[i])]);
        EXPECT_FALSE(reached[clearance.cell_at(places[i + 1])]);
        const auto room = std::ranges::find_if(
            scene.plan.rooms, [&](const Room& r) { return r.area_m.contains(places[i]); });
        ASSERT_NE(room, scene.plan.rooms.end());
        EXPECT_GT(0.05 * 0.05 * static_cast<double>(std::ranges::count(reached, true)),
                  0.14 * room->area_m.volume());
      }
    }
    EXPECT_EQ(doors, 7);
    EXPECT_GT(scene.furniture.size(), 20U);
  }
}

/// Where corridors meet, too: a side of one is open there.
TEST(CorridorScenes, NothingHangsInTheMiddleOfACorridor) {
  for (const CorridorOptions& options : corridor_scenes()) {
    const OfficeScene scene = make_corridor_scene(options);
    const Pose2& corner = scene.plan.T_world_starts[2];  // in the middle, where two corridors meet
    int hanging = 0;
    for (const PlacedItem& placed : scene.furniture) {
      if (!hangs_on_wall(placed.item)) continue;
      ++hanging;
      const Eigen::Vector2d at(std::abs(placed.T_world_item.x_m),
                               std::abs(placed.T_world_item.y_m));
      const bool beside_ends = at.x() <= corner.x_m + 0.6 && at.y() <= corner.y_m + 0.6;
      const double off_m = std::min(std::abs(at.x() - corner.x_m), std::abs(at.y() - corner.y_m));
      EXPECT_FALSE(beside_ends && off_m < 0.6)
          << options.name << " " << at.transpose() << ": " << off_m << " m off the middle";
    }
    EXPECT_GT(hanging, 20) << options.name;
  }
}

TEST(OfficeScene, TheDensestHasEveryKindOfFurniture) {
  std::map<OfficeItem, int> count;
  for (const PlacedItem& placed :
       make_office_scene({.name = "dense", .seed = 2025, .large = true, .clutter = 4}).furniture) {
    ++count[placed.item];
  }
  for (int i = 0; i <= static_cast<int>(OfficeItem::poster); ++i) {
    EXPECT_GT(count[static_cast<OfficeItem>(i)], 0) << item_name(static_cast<OfficeItem>(i));
  }
}

/// That the same seed repeats is tested against the checked-in files.
TEST(OfficeScene, AnotherSeedGivesAnotherOffice) {
  const OfficeScene one = make_office_scene({.name = "one", .seed = 1});
  const OfficeScene two = make_office_scene({.name = "two", .seed = 2});
  EXPECT_FALSE(std::ranges::equal(one.furniture, two.furniture, same));
}

TEST(OfficeScene, OptionsAreChecked) {
  EXPECT_THROW(make_office_scene({.name = "odd", .clutter = 5}), ConfigError);
  EXPECT_THROW(make_office_scene({.name = "odd", .clutter = 0}), ConfigError);
}

TEST(FloorPlan, TheOfficesHaveTheirSizesAndWideDoors) {
  EXPECT_EQ(small_office().size_m, Eigen::Vector2d(15, 10));
  EXPECT_EQ(large_office().size_m, Eigen::Vector2d(20, 25));
  EXPECT_EQ(small_office().rooms.size(), 2U);
  for (const FloorPlan& plan : {small_office(), large_office()}) {
    for (const Wall& wall : plan.walls) {
      for (const Opening& opening : wall.openings) EXPECT_GE(opening.width_m, 1.2);
    }
  }
}

TEST(FloorPlan, AWallIsItsPiecesAndOpenings) {
  const Wall wall{{-2, 1}, {4, 1}, {{0.0, 1.5}, {3.0, 1.0}}};
  const auto pieces = wall_pieces(wall);
  ASSERT_EQ(pieces.size(), 3U);
  EXPECT_DOUBLE_EQ(pieces[0].min().x(), -2.0);
  EXPECT_DOUBLE_EQ(pieces[0].max().x(), -0.75);
  EXPECT_DOUBLE_EQ(pieces[1].min().x(), 0.75);
  EXPECT_DOUBLE_EQ(pieces[1].max().x(), 2.5);
  EXPECT_DOUBLE_EQ(pieces[2].min().x(), 3.5);
  EXPECT_DOUBLE_EQ(pieces[2].max().x(), 4.0);
  for (const auto& piece : pieces) EXPECT_NEAR(piece.sizes().y(), kWallThickness_m, 1e-12);
}

TEST(ClearanceMap, DistancesAreThoseToTheNearestOutline) {
  ClearanceMap map({Eigen::Vector2d(0, 0), Eigen::Vector2d(4, 4)}, 0.1, 1.0);
  map.add({{1.0, 1.0}, {2.0, 1.0}, {2.0, 2.0}, {1.0, 2.0}});
  EXPECT_DOUBLE_EQ(map.at({1.55, 1.55}), 0.0);
  EXPECT_NEAR(map.at({2.55, 1.55}), 0.55, 1e-12);
  EXPECT_NEAR(map.at({2.35, 2.45}), std::hypot(0.35, 0.45), 1e-12);
  EXPECT_DOUBLE_EQ(map.at({3.95, 3.95}), 1.0);
}

TEST(ClearanceMap, ADiscPassesGapsWiderThanItself) {
  for (const double gap : {0.9, 1.3}) {
    ClearanceMap map({Eigen::Vector2d(0, 0), Eigen::Vector2d(6, 4)}, 0.1, 1.0);
    map.add({{2.9, -1.0}, {3.1, -1.0}, {3.1, 2.0 - gap / 2}, {2.9, 2.0 - gap / 2}});
    map.add({{2.9, 2.0 + gap / 2}, {3.1, 2.0 + gap / 2}, {3.1, 5.0}, {2.9, 5.0}});
    const auto reached = map.reachable({1.0, 2.0}, 0.5);
    EXPECT_TRUE(reached[map.cell_at({2.0, 2.0})]);
    EXPECT_EQ(reached[map.cell_at({5.0, 2.0})], gap > 1.0);
  }
}

}  // namespace
}  // namespace vantage
