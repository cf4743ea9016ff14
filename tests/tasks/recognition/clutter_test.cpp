// What stands on the table: drawn by the seed, apart, and physically possible.
#include <gmock/gmock.h>

#include <numbers>
#include <set>

#include "tests/support/overrides.hpp"
#include "vantage/tasks/episode.hpp"
#include "vantage/tasks/flight/object_mjcf.hpp"
#include "vantage/tasks/recognition/recognition_ground_truth.hpp"
#include "vantage/tasks/recognition/standing_room.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

RecognitionTask task_with(const std::vector<std::string>& overrides) {
  const fs::path episode = fs::path(VANTAGE_SOURCE_DIR) / "assets/episodes/recognition.yaml";
  return std::get<RecognitionTask>(load_episode(episode, overrides).task);
}

TEST(Outlines, GapsAreThoseOfSquares) {
  const Outline square{{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}};
  EXPECT_NEAR(gap_m(square, placed(square, 0.0, {3.0, 0.0})), 1.0, 1e-12);
  EXPECT_NEAR(gap_m(square, placed(square, 0.0, {5.0, 6.0})), 5.0, 1e-12) << "corner to corner";
  EXPECT_NEAR(gap_m(square, placed(square, std::numbers::pi / 4.0, {3.0, 0.0})),
              2.0 - std::sqrt(2.0), 1e-12);
  EXPECT_EQ(gap_m(square, placed(square, 0.3, {0.2, 0.1})), 0.0);
  EXPECT_EQ(gap_m(square, placed(square, 0.0, {0.0, 0.0})), 0.0) << "one in the other";
}

/// Long things that cross, no corner of one in the other.
TEST(Outlines, ACrossHasNoGap) {
  const Outline bar{{-2.0, -0.1}, {2.0, -0.1}, {2.0, 0.1}, {-2.0, 0.1}};
  EXPECT_EQ(gap_m(bar, placed(bar, std::numbers::pi / 2.0, {0.0, 0.0})), 0.0);
}

TEST(StandingRoom, PlacesAreApartAndOnTheTable) {
  const std::vector<Eigen::Vector2d> middle{Eigen::Vector2d::Zero()};
  StandingRoom room({middle, 0.3, 0.05, {1.0, 1.0}});
  Rng rng(3);
  const Outline bar{{-0.1, -0.03}, {0.1, -0.03}, {0.1, 0.03}, {-0.1, 0.03}};
  std::vector<Outline> standing;
  StandingRoom::Place place;
  while (standing.size() < 12 && room.place(bar, rng, place)) {
    standing.push_back(placed(bar, place.yaw_rad, place.p_m));
  }
  ASSERT_EQ(standing.size(), 12U);
  for (std::size_t i = 0; i < standing.size(); ++i) {
    for (const Eigen::Vector2d& p : standing[i]) EXPECT_LT(p.cwiseAbs().maxCoeff(), 0.5);
    for (std::size_t j = 0; j < i; ++j) EXPECT_GE(gap_m(standing[i], standing[j]), 0.05);
  }
}

TEST(StandingRoom, AFullTableHasNone) {
  const std::vector<Eigen::Vector2d> middle{Eigen::Vector2d::Zero()};
  StandingRoom room({middle, 0.3, 0.05, {0.3, 0.3}});
  Rng rng(3);
  StandingRoom::Place place;
  room.take(round_outline(0.12));
  EXPECT_FALSE(room.place(round_outline(0.12), rng, place));
}

/// At the table's middle, whichever way it is turned: 1 cm of the table's edge stays free.
TEST(StandingRoom, KeepsOffTheEdgeOfTheTable) {
  const std::vector<Eigen::Vector2d> middle{Eigen::Vector2d::Zero()};
  const auto fits = [&](double table_m) {
    StandingRoom room({middle, 0.0, 0.05, {table_m, table_m}});
    Rng rng(3);
    StandingRoom::Place place;
    return room.place(round_outline(0.1), rng, place);
  };
  EXPECT_TRUE(fits(0.222));
  EXPECT_FALSE(fits(0.214)) << "an outline of 16 corners is 0.098 m wide at least";
}

TEST(Outlines, OfARoundThingHasSixteenCorners) {
  const Outline outline = round_outline(0.5);
  ASSERT_EQ(outline.size(), 16U);
  EXPECT_NEAR((outline[0] - Eigen::Vector2d(0.5, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((outline[2] - Eigen::Vector2d(0.5, 0.5) / std::sqrt(2.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((outline[4] - Eigen::Vector2d(0.0, 0.5)).norm(), 0.0, 1e-12);
}

TEST(Outlines, OfAnObjectIsRoundTheMiddleOfItsBox) {
  TurntableObject object;
  object.obj = "v 1 2 0\nv 3 2 0.5\nvn 9 9 9\nv 3 5 0\nv 1 5 1\nv 2 3 0\nf 1 2 3\n";
  object.box_m = {Eigen::Vector3d(1.0, 2.0, 0.0), Eigen::Vector3d(3.0, 5.0, 1.0)};
  const Outline outline = outline_of(object);
  EXPECT_EQ(outline.size(), 4U);
  for (const Eigen::Vector2d& p : outline) {
    EXPECT_NEAR(std::abs(p.x()), 1.0, 1e-12);
    EXPECT_NEAR(std::abs(p.y()), 1.5, 1e-12);
  }
}

/// Turned by a right angle, then moved.
TEST(Outlines, AreTurnedBeforeTheyAreMoved) {
  const Outline there =
      placed(Outline{Eigen::Vector2d(0.2, 0.1)}, std::numbers::pi / 2.0, {1.0, 2.0});
  EXPECT_NEAR((there[0] - Eigen::Vector2d(0.9, 2.2)).norm(), 0.0, 1e-12);
}

TEST(TableGroundTruth, WithoutClutterIsTheObjectAlone) {
  const RecognitionTask task = task_with({});
  const TableGroundTruth table = draw_table(task, 3);
  const ObjectOnTable alone = draw_object(task, 3);
  ASSERT_EQ(table.targets.size(), 1U);
  EXPECT_TRUE(table.others.empty());
  EXPECT_EQ(table.targets[0].object, alone.object);
  EXPECT_EQ(table.targets[0].offset_m, alone.offset_m);
  EXPECT_EQ(table.targets[0].yaw_rad, alone.yaw_rad);
}

TEST(TableGroundTruth, ClutterLeavesTheTargetWhereItWas) {
  const RecognitionTask task = task_with({"clutter={objects: 9, near_duplicates: 2, tall: 3}"});
  const TableGroundTruth table = draw_table(task, 5);
  const ObjectOnTable alone = draw_object(task, 5);
  EXPECT_EQ(table.targets[0].object, alone.object);
  EXPECT_EQ(table.targets[0].offset_m, alone.offset_m);
  ASSERT_EQ(table.others.size(), 9U);
  const TableGroundTruth again = draw_table(task, 5);
  const TableGroundTruth other = draw_table(task, 6);
  EXPECT_EQ(again.others[4].offset_m, table.others[4].offset_m);
  EXPECT_NE(other.others[4].offset_m, table.others[4].offset_m);
}

TEST(TableGroundTruth, NearDuplicatesAndTallOnesAreAmongThem) {
  const RecognitionTask task =
      task_with({"object=mug_1", "clutter={objects: 8, near_duplicates: 2, tall: 3, tall_m: 0.2}"});
  const TableGroundTruth table = draw_table(task, 2);
  EXPECT_EQ(table.others[0].category, "mug");
  EXPECT_EQ(table.others[1].category, "mug");
  std::set<std::string> all{"mug_1"};
  int tall = 0;
  for (const ObjectOnTable& object : table.others) {
    EXPECT_TRUE(all.insert(object.object).second) << object.object << " stands there twice";
    const auto made =
        make_turntable_object(dataset_of(task.database), {object.category, object.object});
    tall += made.box_m.sizes().z() >= 0.2 ? 1 : 0;
  }
  EXPECT_GE(tall, 3);
}

/// Of all things on the table, every two, as their meshes are.
TEST(TableGroundTruth, NothingTouches) {
  const RecognitionTask task =
      task_with({"clutter={objects: 12, posts: 2, spacing_m: 0.04}", "targets=2"});
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const TableGroundTruth table = draw_table(task, seed);
    std::vector<Outline> standing;
    const auto add = [&](const ObjectOnTable& o) {
      const auto made = make_turntable_object(dataset_of(task.database), {o.category, o.object});
      standing.push_back(placed(outline_of(made), o.yaw_rad, o.offset_m));
    };
    for (const ObjectOnTable& target : table.targets) add(target);
    for (const ObjectOnTable& other : table.others) add(other);
    for (const Post& post : table.posts) {
      standing.push_back(placed(round_outline(post.radius_m), 0.0, post.offset_m));
      EXPECT_LE(post.height_m, task.map.height_m);
    }
    for (std::size_t i = 2; i < standing.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) EXPECT_GE(gap_m(standing[i], standing[j]), 0.0399);
    }
    EXPECT_GT(gap_m(standing[0], standing[1]), 0.0) << "targets stand apart";
  }
}

/// The walls stand round the first targets, spacing_m away, and nothing else in between.
TEST(TableGroundTruth, ScreensStandRoundTargets) {
  const RecognitionTask task =
      task_with({"clutter={objects: 6, screens: 2, screen_m: 0.27, spacing_m: 0.04}", "targets=3"});
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const TableGroundTruth table = draw_table(task, seed);
    ASSERT_EQ(table.screens.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
      const Screen& screen = table.screens[i];
      const ObjectOnTable& target = table.targets[i];
      EXPECT_EQ(screen.height_m, 0.27);
      const auto made =
          make_turntable_object(dataset_of(task.database), {target.category, target.object});
      for (const Eigen::Vector2d& p :
           placed(outline_of(made), target.yaw_rad, target.offset_m - screen.offset_m)) {
        const Eigen::Vector2d in_screen = Eigen::Rotation2Dd(-screen.yaw_rad) * p;
        EXPECT_LE(in_screen.cwiseAbs().maxCoeff(), screen.half_m - 0.0399);
      }
      for (const ObjectOnTable& other : table.others) {
        EXPECT_GT((other.offset_m - screen.offset_m).norm(), screen.half_m);
      }
      EXPECT_GE(gap_m(outline_of(screen), outline_of(table.screens[1 - i])), 0.0399);
    }
  }
}

TEST(TableGroundTruth, AScreenForEveryTargetAndNoMore) {
  EXPECT_THROW(draw_table(task_with({"clutter.screens=2"}), 1), ConfigError);
  EXPECT_EQ(draw_table(task_with({"clutter.screens=1"}), 1).screens.size(), 1U);
}

TEST(TableObstacles, AScreenIsOpenAlongItsYaw) {
  const std::string mjcf =
      mjcf_of(Screen{.offset_m = {0.1, 0.2}, .yaw_rad = 0.5, .half_m = 0.095, .height_m = 0.3},
              "screen_0", {1.0, 2.0, 0.7});
  EXPECT_THAT(mjcf, testing::HasSubstr(R"(pos="1.1 2.2 0.7" euler="0 0 0.5")"));
  EXPECT_THAT(mjcf, testing::HasSubstr(R"(back" type="box" pos="-0.1 0 0.15")"));
  EXPECT_THAT(mjcf, testing::Not(testing::HasSubstr(R"(pos="0.1 0)"))) << "no wall at its front";
}

TEST(TableObstacles, AScreenLeavesRoomRoundItsObject) {
  const Outline object{{-0.06, -0.08}, {0.06, -0.08}, {0.06, 0.04}, {-0.06, 0.04}};
  const Screen screen = screen_round(object, 0.05, 0.27);
  EXPECT_NEAR(screen.half_m, 0.1 + 0.03 + 0.05, 1e-12);
  EXPECT_EQ(screen.height_m, 0.27);
  const Outline round = outline_of(Screen{
      .offset_m = {1.0, 2.0}, .yaw_rad = std::numbers::pi / 2.0, .half_m = 0.18, .height_m = 0.27});
  ASSERT_EQ(round.size(), 4U);
  EXPECT_NEAR((round[0] - Eigen::Vector2d(1.19, 1.81)).norm(), 0.0, 1e-12) << "walls of 1 cm";
  EXPECT_NEAR((round[1] - Eigen::Vector2d(1.19, 2.19)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((round[2] - Eigen::Vector2d(0.81, 2.19)).norm(), 0.0, 1e-12);
}

TEST(TableObstacles, StandOnTheTable) {
  const std::string post = mjcf_of(Post{.offset_m = {0.1, 0.25}, .radius_m = 0.03, .height_m = 0.5},
                                   "post_0", {1.0, 2.0, 0.7});
  EXPECT_THAT(post, testing::HasSubstr(R"(<body name="post_0" pos="1.1 2.25 0.7">)"));
  EXPECT_THAT(post, testing::HasSubstr(R"(type="cylinder" pos="0 0 0.25" size="0.03 0.25")"));
  const std::string screen =
      mjcf_of(Screen{.half_m = 0.095, .height_m = 0.3}, "screen_0", {1.0, 2.0, 0.7});
  EXPECT_THAT(screen, testing::HasSubstr(R"(pos="-0.1 0 0.15" size="0.005 0.105 0.15")"));
  EXPECT_THAT(screen, testing::HasSubstr(R"(left" type="box" pos="0 0.1 0.15" size="0.095 0.005)"));
  EXPECT_THAT(screen,
              testing::HasSubstr(R"(right" type="box" pos="0 -0.1 0.15" size="0.095 0.00)"));
}

TEST(TableGroundTruth, TooMuchForTheTableIsAnError) {
  const RecognitionTask task = task_with({"clutter={objects: 40, spacing_m: 0.2}"});
  try {
    draw_table(task, 1);
    FAIL() << "there is no room";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("clutter.objects"));
    EXPECT_THAT(error.what(), testing::HasSubstr("spacing_m"));
  }
}

/// The last of the stock that finds no room was not one too few.
TEST(TableGroundTruth, AStockThatIsTriedInVainHasNoRoom) {
  const RecognitionTask task = task_with(
      {"clutter={objects: 10, spacing_m: 0.5}", "map.size_m=[0.4, 0.4]", "database.objects=20"});
  try {
    draw_table(task, 1);
    FAIL() << "there is no room";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("no room for 10"));
  }
}

TEST(TableGroundTruth, MoreThanTheDatabaseHasIsAnError) {
  EXPECT_THROW(draw_table(task_with({"database.objects=5", "clutter.objects=6"}), 1), ConfigError);
}

/// All over the disc, turned any way; where that is taken, farther off.
TEST(StandingRoom, PlacesAreInReachWhileThereIsRoom) {
  const std::vector<Eigen::Vector2d> middle{Eigen::Vector2d::Zero()};
  Rng rng(3);
  StandingRoom::Place place;
  int far = 0;
  int ahead = 0;
  int turned_little = 0;
  for (int i = 0; i < 400; ++i) {
    StandingRoom room({middle, 0.3, 0.05, {2.0, 2.0}});
    ASSERT_TRUE(room.place(round_outline(0.02), rng, place));
    EXPECT_LE(place.p_m.norm(), 0.3 + 1e-12);
    const double heading_rad = std::atan2(place.p_m.y(), place.p_m.x());
    far += place.p_m.norm() > 0.28 ? 1 : 0;
    ahead += heading_rad > 0.0 && heading_rad < 1.0 ? 1 : 0;
    turned_little += place.yaw_rad < 1.0 ? 1 : 0;
  }
  EXPECT_GT(far, 20) << "51 on average";
  EXPECT_GT(ahead, 30) << "64 on average";
  EXPECT_GT(turned_little, 30) << "64 on average";
  StandingRoom taken({middle, 0.1, 0.05, {2.0, 2.0}});
  taken.take(round_outline(0.3));
  ASSERT_TRUE(taken.place(round_outline(0.02), rng, place));
  EXPECT_GT(place.p_m.norm(), 0.36);
}

/// 48 posts, from the least to the greatest.
TEST(TableGroundTruth, PostsAreThinAndNearlyAsHighAsTheMap) {
  const RecognitionTask task = task_with({"clutter={objects: 0, posts: 8}"});
  std::vector<double> radii_m;
  std::vector<double> shares;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    for (const Post& post : draw_table(task, seed).posts) {
      radii_m.push_back(post.radius_m);
      shares.push_back(post.height_m / task.map.height_m);
    }
  }
  ASSERT_EQ(radii_m.size(), 48U);
  std::ranges::sort(radii_m);
  std::ranges::sort(shares);
  EXPECT_GE(radii_m.front(), 0.02);
  EXPECT_LT(radii_m.front(), 0.024);
  EXPECT_GT(radii_m.back(), 0.031);
  EXPECT_LE(radii_m.back(), 0.035);
  EXPECT_GE(shares.front(), 0.8);
  EXPECT_LT(shares.front(), 0.85);
  EXPECT_GT(shares.back(), 0.95);
  EXPECT_LE(shares.back(), 1.0);
}

/// A quarter of a metre apart, 0.2 m from the table's edge, and anywhere within that.
TEST(TableGroundTruth, TargetsAreSpreadOverTheTable) {
  const RecognitionTask task = task_with({"targets=2", "map.size_m=[1.2, 0.8]"});
  double least_m = 1.0;
  Eigen::Array2d most_m = Eigen::Array2d::Zero();
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const TableGroundTruth table = draw_table(task, seed);
    ASSERT_EQ(table.targets.size(), 2U);
    least_m = std::min(least_m, (table.targets[0].told_m - table.targets[1].told_m).norm());
    for (const ObjectOnTable& target : table.targets) {
      most_m = most_m.max(target.told_m.array().abs());
    }
  }
  EXPECT_GE(least_m, 0.25);
  EXPECT_LT(least_m, 0.4);
  EXPECT_LE(most_m.x(), 0.4);
  EXPECT_GT(most_m.x(), 0.25);
  EXPECT_LE(most_m.y(), 0.2);
  EXPECT_GT(most_m.y(), 0.12);
}

TEST(TableGroundTruth, AllOfItIsInTheScene) {
  const RecognitionTask task =
      task_with({"targets=2", "clutter={objects: 2, near_duplicates: 0, posts: 1, screens: 1}"});
  const std::vector<MemoryFile> files = table_files(task, draw_table(task, 3));
  std::vector<std::string> names;
  for (const MemoryFile& file : files) names.push_back(file.name);
  EXPECT_THAT(names, testing::ElementsAre("object.xml", "object.obj", "object.png", "object_1.obj",
                                          "object_1.png", "other_0.obj", "other_0.png",
                                          "other_1.obj", "other_1.png"));
  for (const char* body : {"object", "object_1", "other_0", "other_1", "post_0", "screen_0"}) {
    EXPECT_THAT(files[0].content, testing::HasSubstr(std::string("<body name=\"") + body + "\""));
  }
}

TEST(TableGroundTruth, TargetsWithoutRoomSayHowLargeTheTableIs) {
  const RecognitionTask task = task_with({"targets=2", "map.size_m=[0.5, 0.45]"});
  try {
    draw_table(task, 1);
    FAIL() << "they stand a quarter of a metre apart";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(),
                testing::HasSubstr("no room for 2 of them on a table of 0.5 x 0.45 m"));
  }
}

/// Beyond five times the reach nothing is looked for: 0.5 m, where 0.56 m would be free.
TEST(StandingRoom, ReachesFiveTimesAsFarAtMost) {
  const std::vector<Eigen::Vector2d> middle{Eigen::Vector2d::Zero()};
  StandingRoom room({middle, 0.1, 0.05, {4.0, 4.0}});
  room.take(round_outline(0.5));
  Rng rng(3);
  StandingRoom::Place place;
  EXPECT_FALSE(room.place(round_outline(0.02), rng, place));
}

/// A triangle with its corners on a circle round `middle_m`.
Outline drawn_triangle(Rng& rng, const Eigen::Vector2d& middle_m) {
  Outline triangle;
  for (int i = 0; i < 3; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi / 3.0 * i + rng.uniform(-0.8, 0.8);
    triangle.emplace_back(middle_m +
                          0.5 * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad)));
  }
  return triangle;
}

/// Places of a triangle, a sixteenth of its edges apart.
std::vector<Eigen::Vector2d> all_over(const Outline& triangle) {
  constexpr int kParts = 16;
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i <= kParts; ++i) {
    for (int j = 0; i + j <= kParts; ++j) {
      const double u = static_cast<double>(i) / kParts;
      const double v = static_cast<double>(j) / kParts;
      places.emplace_back((1.0 - u - v) * triangle[0] + u * triangle[1] + v * triangle[2]);
    }
  }
  return places;
}

TEST(Outlines, GapsAreThoseOfTheNearestPlaces) {
  Rng rng(5);
  int apart = 0;
  for (int i = 0; i < 60; ++i) {
    const Outline a = drawn_triangle(rng, {0.0, 0.0});
    const Outline b = drawn_triangle(rng, {rng.uniform(-1.2, 1.2), rng.uniform(-1.2, 1.2)});
    double nearest_m = 10.0;
    for (const Eigen::Vector2d& p : all_over(a)) {
      for (const Eigen::Vector2d& q : all_over(b)) nearest_m = std::min(nearest_m, (p - q).norm());
    }
    EXPECT_LE(gap_m(a, b), nearest_m + 1e-9) << i;
    EXPECT_GE(gap_m(a, b), nearest_m - 0.08) << i;
    EXPECT_NEAR(gap_m(a, b), gap_m(b, a), 1e-12) << i;
    apart += gap_m(a, b) > 0.1 ? 1 : 0;
  }
  EXPECT_GT(apart, 10);
  EXPECT_LT(apart, 58);
}

}  // namespace
}  // namespace vantage
