#include "vantage/planners/views/sampled_views.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <numbers>
#include <set>

#include "tests/support/octomap_bytes.hpp"
#include "tests/support/temporary_directory.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using ::testing::HasSubstr;

const Eigen::AlignedBox3d kEverywhere{
    Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity()),
    Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity())};

class SampledViewsOnAMap : public ::testing::Test {
 protected:
  OctomapFile map(const std::vector<support::MapCube>& cubes, double resolution_m = 0.1) {
    std::ofstream(directory_ / "map.bt", std::ios::binary)
        << support::octomap_bytes(cubes, resolution_m);
    return OctomapFile(directory_ / "map.bt");
  }
  static std::vector<Candidate> sample(const SampledViews& options, const OctomapFile& map,
                                       const Eigen::AlignedBox3d& within_m = kEverywhere,
                                       std::uint64_t seed = 1) {
    Rng rng(seed);
    return sample_views(options, map, within_m, rng);
  }
  static std::string error_of(const SampledViews& options, const OctomapFile& map) {
    try {
      sample(options, map);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  support::TemporaryDirectory directory_;
};

TEST_F(SampledViewsOnAMap, StandInFreeCellsClearOfOccupiedOnes) {
  const std::vector<support::MapCube> cubes{
      {{0, 0, 0}, 32, false}, {{32, 0, 0}, 32, true}, {{4096, 0, 0}, 8, false}};
  const SampledViews options{.positions = 40, .headings = 3, .clearance_m = 0.5, .pitch_rad = 0.2};
  const auto views = sample(options, map(cubes));
  ASSERT_EQ(views.size(), 120U);
  bool far = false;
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_EQ(views[i].id, static_cast<int>(i));
    const Eigen::Vector3d p = views[i].T_world_sensor.translation();
    const bool near = p.x() >= 0.0 && p.x() <= 3.2 - 0.5;
    far = far || !near;
    EXPECT_TRUE(near || (p.x() >= 409.6 && p.x() <= 410.4)) << p.transpose();
    EXPECT_NEAR(views[i].T_world_sensor.linear()(2, 0), -std::sin(0.2), 1e-12);
  }
  EXPECT_TRUE(far);  // spread out: the small room far away has its view
}

TEST_F(SampledViewsOnAMap, KeepToHeightAndBox) {
  const std::vector<support::MapCube> cubes{{{0, 0, 0}, 64, false}};
  const Eigen::AlignedBox3d box{Eigen::Vector3d(1.0, 2.0, 3.0), Eigen::Vector3d(2.0, 2.5, 4.0)};
  for (const auto& view : sample({.positions = 25}, map(cubes), box)) {
    EXPECT_TRUE(box.contains(view.T_world_sensor.translation()));
  }
  for (const auto& view : sample({.positions = 25, .height_m = 1.05}, map(cubes))) {
    EXPECT_EQ(view.T_world_sensor.translation().z(), 1.05);
  }
}

TEST_F(SampledViewsOnAMap, DrawEvenlyBySize) {
  // A ninth of the free volume is in the small room, and all of it is less than a cubic metre.
  const std::vector<support::MapCube> cubes{{{0, 0, 0}, 64, false}, {{-64, 0, 0}, 32, false}};
  int small = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const auto views = sample({.positions = 1, .headings = 1}, map(cubes, 0.01), kEverywhere, seed);
    small += views.front().T_world_sensor.translation().x() < 0.0 ? 1 : 0;
  }
  EXPECT_NEAR(small / 300.0, 1.0 / 9.0, 4.0 * std::sqrt(1.0 / 9.0 * 8.0 / 9.0 / 300.0));
}

TEST_F(SampledViewsOnAMap, SameSeedSameViews) {
  const std::vector<support::MapCube> cubes{{{0, 0, 0}, 64, false}};
  const auto first = sample({}, map(cubes));
  const auto again = sample({}, map(cubes));
  const auto other = sample({}, map(cubes), kEverywhere, 2);
  ASSERT_EQ(first.size(), 240U);
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].T_world_sensor.matrix(), again[i].T_world_sensor.matrix());
  }
  EXPECT_NE(first[0].T_world_sensor.matrix(), other[0].T_world_sensor.matrix());
}

TEST_F(SampledViewsOnAMap, SayWhyThereIsNone) {
  const auto walls = map({{{0, 0, 0}, 8, true}});
  EXPECT_THAT(error_of({}, walls), HasSubstr("map.bt: no free cell"));
  const auto room = map({{{0, 0, 0}, 8, false}, {{8, 0, 0}, 8, true}});
  EXPECT_THAT(error_of({.clearance_m = 2.0}, room), HasSubstr("views.clearance_m = 2"));
  EXPECT_THAT(error_of({.height_m = 5.0}, room), HasSubstr("views.height_m = 5"));
  EXPECT_THROW(sample({.positions = 0}, room), ConfigError);
}

TEST_F(SampledViewsOnAMap, LookRoundEvenlyFromAnyBearing) {
  const std::vector<support::MapCube> cubes{{{0, 0, 0}, 64, false}};
  const auto views = sample({.positions = 12, .headings = 5}, map(cubes));
  ASSERT_EQ(views.size(), 60U);
  std::set<int> first_bearings;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Pose& first = views[i - i % 5].T_world_sensor;
    EXPECT_EQ(views[i].T_world_sensor.translation(), first.translation());
    const double turned_rad = 2.0 * std::numbers::pi * static_cast<double>(i % 5) / 5.0;
    const double off_rad = project_to_se2(views[i].T_world_sensor).yaw_rad -
                           project_to_se2(first).yaw_rad - turned_rad;
    EXPECT_NEAR(wrap_angle(off_rad), 0.0, 1e-9) << i;
    first_bearings.insert(static_cast<int>(project_to_se2(first).yaw_rad * 1e6));
  }
  EXPECT_EQ(first_bearings.size(), 12U);
}

/// Free on either side of a wall along x = 0 to 3.2 m.
TEST_F(SampledViewsOnAMap, KeepTheClearanceOnBothSidesAndNoMore) {
  const std::vector<support::MapCube> cubes{
      {{-32, 0, 0}, 32, false}, {{0, 0, 0}, 32, true}, {{32, 0, 0}, 32, false}};
  double left_m = -10.0;
  double right_m = 10.0;
  int left = 0;
  for (const auto& view :
       sample({.positions = 200, .headings = 1, .clearance_m = 0.5}, map(cubes))) {
    const double x_m = view.T_world_sensor.translation().x();
    left += x_m < 1.6 ? 1 : 0;
    if (x_m < 1.6) left_m = std::max(left_m, x_m);
    if (x_m > 1.6) right_m = std::min(right_m, x_m);
  }
  EXPECT_LE(left_m, -0.5);
  EXPECT_GT(left_m, -0.75);
  EXPECT_GE(right_m, 3.7);
  EXPECT_LT(right_m, 3.95);
  EXPECT_NEAR(left, 100, 30) << "both sides are of one size";
}

TEST_F(SampledViewsOnAMap, LookInEveryDirection) {
  const std::vector<support::MapCube> cubes{{{0, 0, 0}, 64, false}};
  std::array<int, 8> looking{};
  for (const auto& view : sample({.positions = 200, .headings = 1}, map(cubes))) {
    const double turns =
        project_to_se2(view.T_world_sensor).yaw_rad / (2.0 * std::numbers::pi) + 0.5;
    ++looking[std::min<std::size_t>(static_cast<std::size_t>(8.0 * turns), 7)];
  }
  EXPECT_THAT(looking, ::testing::Each(::testing::Gt(3)));
}

TEST_F(SampledViewsOnAMap, ALevelWhereALeafEndsIsThatOfWhatIsAbove) {
  const auto room = map({{{0, 0, 0}, 8, false}}, 0.125);
  EXPECT_THAT(error_of({.height_m = 1.0}, room), HasSubstr("no free cell at views.height_m = 1"));
  EXPECT_EQ(error_of({.height_m = 0.0}, room), "no error");
}

/// Four numbers each; the first one drawn is taken first.
TEST_F(SampledViewsOnAMap, AreTakenFromTenTimesAsManyPlaces) {
  const auto room = map({{{0, 0, 0}, 32, false}});
  const auto views = sample({.positions = 1, .headings = 1}, room);
  ASSERT_EQ(views.size(), 1U);
  Rng rng(1);
  rng.uniform();  // in which leaf: there is one
  Eigen::Vector3d place_m;
  for (int axis = 0; axis < 3; ++axis) place_m[axis] = 3.2 * rng.uniform();
  for (int k = 0; k < 9 * 4; ++k) rng.uniform();
  const double yaw_rad = wrap_angle(rng.uniform(0.0, 2.0 * std::numbers::pi));
  const Pose& T_world_sensor = views.front().T_world_sensor;
  EXPECT_LT((T_world_sensor.translation() - place_m).norm(), 1e-9);
  EXPECT_NEAR(project_to_se2(T_world_sensor).yaw_rad, yaw_rad, 1e-9);
}

/// Of four parts, which the map has one by one: a place that is near one of them hides none from
/// the others.
TEST_F(SampledViewsOnAMap, KeepClearOfEveryPartOfAWall) {
  const std::vector<support::MapCube> cubes{{{-32, 0, 0}, 32, false},
                                            {{0, 0, 0}, 16, true},
                                            {{0, 16, 0}, 16, true},
                                            {{0, 0, 16}, 16, true},
                                            {{0, 16, 16}, 16, true}};
  const auto views = sample({.positions = 200, .headings = 1, .clearance_m = 0.5}, map(cubes));
  ASSERT_EQ(views.size(), 200U);
  for (const auto& view : views) EXPECT_LE(view.T_world_sensor.translation().x(), -0.5);
}

/// The room begins where the floor ends, and the views are to stand just there.
TEST_F(SampledViewsOnAMap, WithoutAClearanceTheyMayTouchWhatIsOccupied) {
  const auto room = map({{{0, 0, 0}, 8, true}, {{0, 0, 8}, 8, false}}, 0.125);
  EXPECT_EQ(error_of({.height_m = 1.0, .clearance_m = 0.0}, room), "no error");
  EXPECT_THAT(error_of({.height_m = 1.0, .clearance_m = 0.01}, room),
              HasSubstr("views.clearance_m = 0.01"));
}

/// So no place is farther from those before it than the one taken before was.
TEST_F(SampledViewsOnAMap, AreEachTheFarthestFromThoseBefore) {
  const auto room = map({{{0, 0, 0}, 32, false}});
  const auto views = sample({.positions = 30, .headings = 1}, room);
  ASSERT_EQ(views.size(), 30U);
  double last_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < views.size(); ++i) {
    double nearest_m = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < i; ++k) {
      const Eigen::Vector3d between =
          views[i].T_world_sensor.translation() - views[k].T_world_sensor.translation();
      nearest_m = std::min(nearest_m, between.norm());
    }
    EXPECT_LE(nearest_m, last_m + 1e-12) << i;
    EXPECT_GT(nearest_m, 0.3) << i;
    last_m = nearest_m;
  }
}

/// Free above the box, below it and on all sides.
TEST_F(SampledViewsOnAMap, KeepToTheBoxWhateverIsFreeRoundIt) {
  std::vector<support::MapCube> cubes;
  for (int i = 0; i < 27; ++i) {
    cubes.push_back({{64 * (i % 3 - 1), 64 * (i / 3 % 3 - 1), 64 * (i / 9 - 1)}, 64, false});
  }
  const Eigen::AlignedBox3d box{Eigen::Vector3d(1.0, 2.0, 3.0), Eigen::Vector3d(2.0, 2.5, 4.0)};
  const auto views = sample({.positions = 25, .headings = 1}, map(cubes), box);
  ASSERT_EQ(views.size(), 25U);
  for (const auto& view : views) {
    EXPECT_TRUE(box.contains(view.T_world_sensor.translation()));
  }
}

}  // namespace
}  // namespace vantage
