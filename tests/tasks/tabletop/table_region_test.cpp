// The region of interest follows the table.
#include "vantage/tasks/tabletop/table_region.hpp"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "tests/tasks/tabletop/own_scene.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/sim/world/world.hpp"
#include "vantage/tasks/episode.hpp"
#include "vantage/tasks/tabletop/start_check.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using support::OwnScene;
using support::table_at;
using testing::ElementsAre;
using testing::HasSubstr;

Tabletop resolved(const fs::path& scene, std::vector<std::string> more) {
  more.push_back("scene=" + scene.string());
  const auto file = fs::path(VANTAGE_SOURCE_DIR) / "assets/episodes/tabletop.yaml";
  return std::get<Tabletop>(load_episode(file, more).task);
}

/// What episodes and their hashes were recorded with.
TEST(TableRegion, OfOurScenesIsTheDefaultToTheLastBit) {
  for (const char* name : {"tabletop_4", "tabletop_8", "tabletop_15", "tabletop_25"}) {
    const auto scene = fs::path(VANTAGE_SOURCE_DIR) / "models/scenes" / name / "scene.xml";
    const MapOptions map = resolved(scene, {}).map;
    EXPECT_EQ(*map.centre_m, MapOptions::kCentre_m) << name;
    EXPECT_EQ(*map.size_m, MapOptions::kSize_m) << name;
    EXPECT_EQ(*map.cells, MapOptions::kCells) << name;
  }
}

TEST(TableRegion, FollowsATableWhereverItStands) {
  const OwnScene scene(table_at(2.0, -1.0, 0.42, 0.6, 0.4));
  const MapOptions map = resolved(scene.path(), {}).map;
  EXPECT_THAT(*map.centre_m, ElementsAre(2.0, -1.0, 0.682));
  EXPECT_THAT(*map.size_m, ElementsAre(1.2, 0.8, 0.504));
  EXPECT_THAT(*map.cells, ElementsAre(155, 103, 65));
  EXPECT_NEAR(map.frame().box().min().z(), 0.43, 1e-9) << "1 cm above the top";
}

TEST(TableRegion, WhatTheEpisodeSaysStays) {
  const OwnScene scene(table_at(2.0, -1.0, 0.42, 0.6, 0.4));
  const auto centre = resolved(scene.path(), {"map.centre_m=[0,0,1.012]"}).map;
  EXPECT_THAT(*centre.centre_m, ElementsAre(0.0, 0.0, 1.012));
  EXPECT_EQ(*centre.size_m, MapOptions::kSize_m);
  EXPECT_EQ(*centre.cells, MapOptions::kCells);
  const auto size = resolved(scene.path(), {"map.size_m=[2,1,0.5]"}).map;
  EXPECT_THAT(*size.size_m, ElementsAre(2.0, 1.0, 0.5));
  EXPECT_THAT(*size.centre_m, ElementsAre(2.0, -1.0, 0.68));
  EXPECT_EQ(*size.cells, MapOptions::kCells);
  const auto cells = resolved(scene.path(), {"map.cells=[33,33,17]", "map.size_m=auto"}).map;
  EXPECT_THAT(*cells.cells, ElementsAre(33, 33, 17));
  EXPECT_THAT(*cells.size_m, ElementsAre(1.2, 0.8, 0.504));
}

/// What counts is the map as it follows the table, not what is the default.
TEST(TableRegion, HasNoMoreCellsThanAllViewsMaySee) {
  const OwnScene large(table_at(0.0, 0.0, 0.42, 1.0, 1.0));
  EXPECT_NO_THROW(resolved(large.path(), {"candidates.positions=170"}));
  try {
    resolved(large.path(), {"candidates.positions=200"});
    FAIL() << "more than 4 million cells of 600 views";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("cells times 600 views"));
    EXPECT_THAT(error.what(), HasSubstr("--set candidates.positions: "));
  }
  const OwnScene small(table_at(0.0, 0.0, 0.42, 0.3, 0.3));
  EXPECT_NO_THROW(resolved(small.path(), {"candidates.positions=1000"}));
}

TEST(TableRegion, TheResolvedEpisodeHasNumbers) {
  const OwnScene scene(table_at(0.0, 0.0, 0.42, 0.5, 0.5));
  const auto file = fs::path(VANTAGE_SOURCE_DIR) / "assets/episodes/tabletop.yaml";
  const auto episode = load_episode(file, {"scene=" + scene.path().string(), "map.centre_m=auto"});
  const std::string yaml = episode_yaml(episode);
  EXPECT_THAT(yaml, HasSubstr("0.682"));
  const auto again = resolve_episode(parse_yaml(yaml, "config.yaml"), file);
  EXPECT_EQ(episode_yaml(again), yaml);
}

TEST(TableRegion, OverTheOriginComesBeforeTheLargest) {
  const LevelSurface far{{Eigen::Vector2d(2, 2), Eigen::Vector2d(5, 5)}, 0.9, 9.0, "counter"};
  const LevelSurface here{{Eigen::Vector2d(-1, -1), Eigen::Vector2d(1, 1)}, 0.7, 4.0, "table"};
  EXPECT_EQ(table_among({far, here})->name, "table");
  EXPECT_EQ(table_among({far})->name, "counter");
  EXPECT_FALSE(table_among({}));
}

TEST(TableRegion, BesideTheOriginIsNotOverIt) {
  const auto square = [](double x_m, double y_m, const char* name) {
    return LevelSurface{
        {Eigen::Vector2d(x_m - 0.5, y_m - 0.5), Eigen::Vector2d(x_m + 0.5, y_m + 0.5)},
        0.7,
        1.0,
        name};
  };
  const LevelSurface here = square(0.3, -0.3, "here");
  for (const auto& [x_m, y_m] : {std::pair(0.0, 1.0), {1.0, 0.0}, {0.0, -1.0}, {-1.0, 0.0}}) {
    const LevelSurface beside = square(x_m, y_m, "beside");
    EXPECT_EQ(table_among({beside, here})->name, "here") << x_m << " " << y_m;
    EXPECT_EQ(table_among({beside, square(3.0, 3.0, "far")})->name, "beside") << "the largest";
  }
}

/// Of a map of half a metre over a table of a metre at 0.72 m.
class TableInTheMap : public testing::Test {
 protected:
  /// Whose lower face is `gap_m` above the table; what is said of it.
  std::vector<std::string> notes(double gap_m) {
    Tabletop task;
    task.map.centre_m = {0.0, 0.0, 0.72 + gap_m + 0.25};
    task.map.size_m = {0.5, 0.5, 0.5};
    return check_table(world_, setup_, task);
  }
  std::string refusal(double gap_m) {
    try {
      notes(gap_m);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  }

  OwnScene scene_{table_at(0.0, 0.0, 0.72, 0.5, 0.5)};
  World world_{ModelSource{.scene = scene_.path(), .robot = {}}};
  EpisodeSetup setup_{.options = {}, .name = "", .scene = scene_.path(), .robot = {}};
};

TEST_F(TableInTheMap, IsNoMoreThanATenthOfAMetreBelowIt) {
  EXPECT_TRUE(notes(0.01).empty());
  EXPECT_TRUE(notes(0.098).empty());
  EXPECT_THAT(refusal(0.102), HasSubstr("begins 0.10 m above the table"));
  EXPECT_THAT(refusal(0.3), testing::AllOf(HasSubstr("begins 0.30 m above the table"),
                                           HasSubstr("'top' at x -0.5 to 0.5, y -0.5 to 0.5, z "
                                                     "0.720")));
}

TEST_F(TableInTheMap, MayTouchItAndIsRemarkedOnWhereItIsInIt) {
  EXPECT_TRUE(notes(-0.004).empty()) << "by noise";
  ASSERT_EQ(notes(-0.006).size(), 1U);
  EXPECT_THAT(notes(-0.006)[0], HasSubstr("0.006 m below the table top"));
  ASSERT_EQ(notes(-0.12).size(), 1U);
  EXPECT_THAT(notes(-0.12)[0], HasSubstr("0.120 m below the table top"));
}

/// What lies lower than objects.min_height_m is none of the clutter.
TEST_F(TableInTheMap, HasRoomForObjectsAboveIt) {
  EXPECT_EQ(notes(-0.488).size(), 1U);
  EXPECT_THAT(refusal(-0.492), HasSubstr("miss the table"));
  EXPECT_THAT(refusal(-0.7), HasSubstr("miss the table"));
}

}  // namespace
}  // namespace vantage
