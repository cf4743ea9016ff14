#include "vantage/models/catalogue/table/table_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "vantage/core/error.hpp"
#include "vantage/models/catalogue/shapes/footprint.hpp"
#include "vantage/models/catalogue/table/scene_mjcf.hpp"

namespace vantage {
namespace {

Outline footprint(const PlacedObject& placed) {
  return moved(placed.object.footprint_m, placed.T_world_object);
}

bool stacked(const TableScene& scene, std::size_t a, std::size_t b) {
  return scene.objects[a].support == b || scene.objects[b].support == a;
}

class StandardScene : public testing::TestWithParam<TableSceneOptions> {};

TEST_P(StandardScene, HasTheObjectsAndStacksAskedFor) {
  const TableScene scene = make_table_scene(GetParam());
  EXPECT_EQ(scene.objects.size(), static_cast<std::size_t>(GetParam().objects));
  const auto riders =
      std::ranges::count_if(scene.objects, [](const auto& o) { return o.support.has_value(); });
  EXPECT_EQ(riders, GetParam().stacks);
}

TEST_P(StandardScene, FootprintsKeepTheirClearance) {
  const TableScene scene = make_table_scene(GetParam());
  for (std::size_t a = 0; a < scene.objects.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (stacked(scene, a, b)) continue;
      EXPECT_FALSE(too_close(footprint(scene.objects[a]), footprint(scene.objects[b]),
                             GetParam().clearance_m - 1e-9))
          << scene.objects[a].spec.name << " and " << scene.objects[b].spec.name;
    }
  }
}

TEST_P(StandardScene, ObjectsStayInTheRegionAndBelowTheLimit) {
  for (const PlacedObject& placed : make_table_scene(GetParam()).objects) {
    for (const auto& p : footprint(placed)) {
      EXPECT_LE(p.cwiseAbs().maxCoeff(), kPlacementHalf_m + 1e-9) << placed.spec.name;
    }
    EXPECT_LT(placed.z_m + placed.object.height_m, kTableTop_m + kMaxHeight_m) << placed.spec.name;
  }
}

TEST_P(StandardScene, EverythingRestsOnTheTableOrOnALevelTop) {
  const TableScene scene = make_table_scene(GetParam());
  for (const PlacedObject& placed : scene.objects) {
    if (!placed.support) {
      EXPECT_EQ(placed.z_m, kTableTop_m);
      continue;
    }
    const PlacedObject& support = scene.objects[*placed.support];
    EXPECT_EQ(placed.z_m, kTableTop_m + support.object.height_m);
    EXPECT_TRUE(placed.object.stands);
    EXPECT_GT(support.object.top_radius_m, 0.0);
    EXPECT_FALSE(support.support.has_value());
    const double apart = std::hypot(placed.T_world_object.x_m - support.T_world_object.x_m,
                                    placed.T_world_object.y_m - support.T_world_object.y_m);
    EXPECT_LT(apart, 1e-9);
  }
}

TEST_P(StandardScene, RepeatsWithItsSeedAndChangesWithAnother) {
  TableSceneOptions options = GetParam();
  const std::string first = to_mjcf(make_table_scene(options));
  EXPECT_EQ(first, to_mjcf(make_table_scene(options)));
  options.seed += 1000;
  EXPECT_NE(first, to_mjcf(make_table_scene(options)));
}

TEST_P(StandardScene, FurnitureLeavesTheRingFreeExceptInTheDensest) {
  const bool densest = GetParam().name == "tabletop_25";
  int on_the_ring = 0;
  for (const Furniture& furniture : GetParam().furniture) {
    const double r = std::hypot(furniture.T_world_furniture.x_m, furniture.T_world_furniture.y_m);
    if (r >= 2.3) continue;
    EXPECT_NEAR(r, 1.45, 0.01);
    ++on_the_ring;
  }
  EXPECT_EQ(on_the_ring, densest ? 1 : 0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, StandardScene, testing::ValuesIn(standard_scenes()),
                         [](const auto& info) { return info.param.name; });

TEST(TableScene, TooMuchForTheTableIsAnError) {
  EXPECT_THROW(
      make_table_scene({.name = "full", .objects = 30, .clearance_m = 0.2, .furniture = {}}),
      ConfigError);
}

TEST(TableScene, OptionsAreChecked) {
  EXPECT_THROW(make_table_scene({.name = "odd", .objects = -1, .furniture = {}}), ConfigError);
}

TEST(TableScene, NoObjectsIsAnEmptyTable) {
  EXPECT_TRUE(make_table_scene({.name = "bare", .objects = 0, .furniture = {}}).objects.empty());
}

}  // namespace
}  // namespace vantage
