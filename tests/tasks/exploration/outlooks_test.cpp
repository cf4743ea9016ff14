// From where to look: two rooms with a door that the camera does not know to be free, and floors
// drawn at random against a search from every place by itself.
#include "vantage/tasks/exploration/outlooks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/planners/navigation/distance_field.hpp"

namespace vantage {
namespace {

/// 6 x 6 m, cells of 0.1 m, and a wall along y = 0 with a door from x = 0.8 to 1.6.
FloorMap two_rooms() {
  FloorMap floor({-3.0, -3.0}, 0.1, 60, 60);
  floor.log_odds.assign(floor.size(), -2.0F);
  for (std::size_t cell = 0; cell < floor.size(); ++cell) {
    const Eigen::Vector2d p_m = floor.centre(floor.cell(cell));
    const bool wall = std::abs(p_m.y()) < 0.1 && (p_m.x() < 0.8 || p_m.x() > 1.6);
    if (wall) floor.log_odds[cell] = 2.0F;
  }
  return floor;
}

constexpr Pose2 kStart{-2.0, -1.5, 0.0};
constexpr NavigationOptions kDisc{.footprint_radius_m = 0.35, .margin_m = 0.0};

Eigen::Vector2d place_towards(const FloorMap& floor, const Eigen::Vector2d& p_m) {
  const PathField paths = make_path_field(floor, kStart, kDisc);
  const auto cell = Outlooks(paths).towards(p_m);
  return cell ? floor.centre(floor.cell(*cell)) : Eigen::Vector2d(NAN, NAN);
}

TEST(Outlooks, AreWhereTheRobotIsToLookFromIfItGetsThere) {
  EXPECT_LT((place_towards(two_rooms(), {1.95, -2.05}) - Eigen::Vector2d(1.95, -2.05)).norm(),
            1e-9);
}

/// Columns behind the posts block the door, by what the camera has not seen.
TEST(Outlooks, AreBeforeTheMiddleOfADoorAndNotBehindAWall) {
  FloorMap floor = two_rooms();
  block_box(floor, {Eigen::Vector2d(0.7, 0.11), Eigen::Vector2d(1.0, 0.29)});
  block_box(floor, {Eigen::Vector2d(1.4, 0.11), Eigen::Vector2d(1.7, 0.29)});
  for (const double x_m : {-2.0, 0.0, 1.2, 2.5}) {
    const Eigen::Vector2d place = place_towards(floor, {x_m, 1.0});
    EXPECT_NEAR(place.x(), 1.2, 0.1) << x_m;
    EXPECT_LT(place.y(), 0.0) << x_m;
    EXPECT_GT(place.y(), -0.6) << x_m;
  }
}

TEST(Outlooks, LeadThroughNoGapThatTheRobotsDiscIsTooWideFor) {
  FloorMap floor = two_rooms();
  for (std::size_t cell = 0; cell < floor.size(); ++cell) {
    const Eigen::Vector2d p_m = floor.centre(floor.cell(cell));
    if (std::abs(p_m.y()) < 0.1 && p_m.x() > 1.1) floor.log_odds[cell] = 2.0F;
  }
  const Eigen::Vector2d place = place_towards(floor, {-2.0, 1.0});
  EXPECT_NEAR(place.x(), -2.0, 0.1) << "no way: the nearest";
}

TEST(Outlooks, NoneAreWhereTheRobotGetsNowhere) {
  FloorMap floor = two_rooms();
  std::ranges::fill(floor.log_odds, 2.0F);
  EXPECT_TRUE(std::isnan(place_towards(floor, {1.0, 1.0}).x()));
}

using Ways = std::vector<double>;

/// From one cell over all that the scanner knows to be free, by relaxing until nothing changes.
Ways ways_from(const FloorMap& floor, const PathField& paths, std::size_t source) {
  Ways way(floor.size(), kInfinity);
  way[source] = 0.0;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t from = 0; from < way.size(); ++from) {
      for (std::size_t to = 0; to < way.size(); ++to) {
        const Eigen::Array2i step = floor.cell(to) - floor.cell(from);
        if (step.abs().maxCoeff() != 1) continue;
        if (floor.log_odds[to] > 0.0F && !paths.reachable(to)) continue;
        const double through = way[from] + floor.cell_m * step.matrix().cast<double>().norm();
        if (through >= way[to] - 1e-6) continue;
        way[to] = through;
        changed = true;
      }
    }
  }
  return way;
}

TEST(Outlooks, AreThoseWithTheShortestWayOn) {
  Rng rng(17);
  int led_on = 0;
  for (int draw = 0; draw < 6; ++draw) {
    FloorMap floor({0.0, 0.0}, 0.1, 9, 8);
    for (std::size_t cell = 0; cell < floor.size(); ++cell) {
      floor.log_odds[cell] = rng.uniform() < 0.25 ? 2.0F : -2.0F;
      floor.blocked[cell] = rng.uniform() < 0.3 ? 1 : 0;
    }
    floor.log_odds[0] = -2.0F;
    floor.blocked[0] = 0;
    const PathField paths =
        make_path_field(floor, {0.05, 0.05, 0.0}, {.footprint_radius_m = 0.0, .margin_m = 0.0});
    std::vector<Ways> ways;
    for (std::size_t cell = 0; cell < floor.size(); ++cell) {
      ways.push_back(paths.reachable(cell) ? ways_from(floor, paths, cell)
                                           : Ways(floor.size(), kInfinity));
    }
    const Outlooks outlooks(paths);
    for (std::size_t to = 0; to < floor.size(); ++to) {
      double shortest = kInfinity;
      for (const Ways& way : ways) shortest = std::min(shortest, way[to]);
      if (shortest == kInfinity) continue;
      const auto from = outlooks.towards(floor.centre(floor.cell(to)));
      ASSERT_TRUE(from);
      EXPECT_TRUE(paths.reachable(*from));
      EXPECT_NEAR(ways[*from][to], shortest, 1e-5) << draw << ", cell " << to;
      led_on += shortest > 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(led_on, 40);
}

}  // namespace
}  // namespace vantage
