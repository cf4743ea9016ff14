// From where to look: two rooms with a door that the camera does not know to be free, and floors
// drawn at random against a search from every place by itself.
#include "vantage/tasks/exploration/outlooks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "vantage/core/rng.hpp"
#include "vantage/planners/navigation/distance_field.hpp"

namespace vantage {
namespace {

/// 6 x 5.5 m, cells of 0.1 m, and a wall along y = 0 with a door from x = 0.8 to 1.6.
FloorMap two_rooms() {
  FloorMap floor({-3.0, -3.0}, 0.1, 60, 55);
  floor.log_odds.assign(floor.size(), -2.0F);
  for (std::size_t cell = 0; cell < floor.size(); ++cell) {
    const Eigen::Vector2d p_m = floor.centre(floor.cell(cell));
    const bool wall = std::abs(p_m.y()) < 0.1 && (p_m.x() < 0.8 || p_m.x() > 1.6);
    if (wall) floor.log_odds[cell] = 2.0F;
  }
  return floor;
}

constexpr Pose2 kStart{-2.0, -1.5, 0.0};

Eigen::Vector2d place_towards(const FloorMap& floor, const Eigen::Vector2d& p_m,
                              double radius_m = 0.35) {
  const PathField paths =
      make_path_field(floor, kStart, {.footprint_radius_m = radius_m, .margin_m = 0.0});
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

/// Five cells wide: its middle is three cells from those beside it, of which half a diagonal may be
/// free.
TEST(Outlooks, LeadThroughAGapThatIsWideEnoughIfItsPostsAreThin) {
  FloorMap floor = two_rooms();
  for (std::size_t cell = 0; cell < floor.size(); ++cell) {
    const Eigen::Vector2d p_m = floor.centre(floor.cell(cell));
    if (std::abs(p_m.y()) < 0.1 && p_m.x() > 1.3) floor.log_odds[cell] = 2.0F;
  }
  EXPECT_GT(place_towards(floor, {-2.0, 1.0}, 0.36).x(), 0.5);
  EXPECT_NEAR(place_towards(floor, {-2.0, 1.0}, 0.38).x(), -2.0, 0.1);
}

TEST(Outlooks, NoneAreWhereTheRobotGetsNowhere) {
  FloorMap floor = two_rooms();
  std::ranges::fill(floor.log_odds, 2.0F);
  EXPECT_TRUE(std::isnan(place_towards(floor, {1.0, 1.0}).x()));
}

TEST(Outlooks, AreInTheOnlyRowOfAFloor) {
  FloorMap floor({0.0, 0.0}, 0.125, 5, 1);
  floor.log_odds.assign(floor.size(), -2.0F);
  const PathField paths =
      make_path_field(floor, {0.0625, 0.0625, 0.0}, {.footprint_radius_m = 0.0, .margin_m = 0.0});
  for (const double y_m : {-1.0, 0.05, 1.0}) {
    EXPECT_EQ(Outlooks(paths).towards({0.4375, y_m}), std::optional<std::size_t>(3)) << y_m;
  }
}

/// Free are the last column and the row two above the one looked at: there the nearest is, 25 cm
/// away, and not where the row meets the column, 88 cm away.
TEST(Outlooks, AreFartherUpOrDownWhereThoseAsideAreFartherStill) {
  FloorMap floor({0.0, 0.0}, 0.125, 8, 9);
  floor.log_odds.assign(floor.size(), 2.0F);
  for (int x = 0; x < 8; ++x) floor.log_odds[floor.index({x, 5})] = -2.0F;
  for (int y = 0; y < 9; ++y) floor.log_odds[floor.index({7, y})] = -2.0F;
  const PathField paths =
      make_path_field(floor, {0.9375, 0.0625, 0.0}, {.footprint_radius_m = 0.0, .margin_m = 0.0});
  EXPECT_EQ(Outlooks(paths).towards(floor.centre({0, 3})), floor.index({0, 5}));
}

using Ways = std::vector<double>;

/// From one cell over all that the scanner knows to be free, by relaxing until nothing changes.
Ways ways_from(const FloorMap& floor, const PathField& paths, std::size_t source) {
  Ways way(floor.size(), kInfinity);
  way[source] = 0.0;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t from = 0; from < way.size(); ++from) {
      for (int step = 0; step < 9; ++step) {
        const Eigen::Array2i along(step % 3 - 1, step / 3 - 1);
        const Eigen::Array2i at = floor.cell(from) + along;
        if (!floor.contains(at)) continue;
        const std::size_t to = floor.index(at);
        if (floor.log_odds[to] > 0.0F && !paths.reachable(to)) continue;
        const double through = way[from] + floor.cell_m * along.matrix().cast<double>().norm();
        if (through >= way[to] - 1e-6) continue;
        way[to] = through;
        changed = true;
      }
    }
  }
  return way;
}

/// Cells of an eighth of a metre, of which sums and squares are exact.
struct DrawnFloor {
  explicit DrawnFloor(Rng& rng) {
    for (std::size_t cell = 0; cell < floor.size(); ++cell) {
      floor.log_odds[cell] = rng.uniform() < 0.25 ? 2.0F : -2.0F;
      floor.blocked[cell] = rng.uniform() < 0.3 ? 1 : 0;
    }
    const std::size_t start = floor.index({4, 3});
    floor.log_odds[start] = -2.0F;
    floor.blocked[start] = 0;
    paths =
        make_path_field(floor, {0.5625, 0.4375, 0.0}, {.footprint_radius_m = 0.0, .margin_m = 0.0});
    for (std::size_t from = 0; from < floor.size(); ++from) {
      ways.push_back(paths.reachable(from) ? ways_from(floor, paths, from)
                                           : Ways(floor.size(), kInfinity));
      for (std::size_t to = 0; to < floor.size(); ++to) {
        shortest[to] = std::min(shortest[to], ways[from][to]);
      }
    }
  }

  FloorMap floor{{0.0, 0.0}, 0.125, 9, 8};
  PathField paths;
  std::vector<Ways> ways;
  Ways shortest = Ways(floor.size(), kInfinity);
};

TEST(Outlooks, AreThoseWithTheShortestWayOn) {
  Rng rng(17);
  int led_on = 0;
  for (int draw = 0; draw < 6; ++draw) {
    const DrawnFloor drawn(rng);
    const Outlooks outlooks(drawn.paths);
    for (std::size_t to = 0; to < drawn.floor.size(); ++to) {
      if (drawn.shortest[to] == kInfinity) continue;
      const auto from = outlooks.towards(drawn.floor.centre(drawn.floor.cell(to)));
      ASSERT_TRUE(from);
      EXPECT_TRUE(drawn.paths.reachable(*from));
      EXPECT_NEAR(drawn.ways[*from][to], drawn.shortest[to], 1e-5) << draw << ", cell " << to;
      led_on += drawn.shortest[to] > 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(led_on, 40);
}

/// On the floor and round it; as often as not between cells that are as near.
TEST(Outlooks, AreTowardsTheNearestPlaceAndOfTwoAsNearTheOneWithTheShorterWay) {
  Rng rng(18);
  for (int draw = 0; draw < 6; ++draw) {
    const DrawnFloor drawn(rng);
    const FloorMap& floor = drawn.floor;
    const Outlooks outlooks(drawn.paths);
    for (int i = 0; i < 200; ++i) {
      const auto sixteenths = [&](std::size_t most) {
        return 0.0625 * (static_cast<double>(rng.uniform_index(most)) - 6.0);
      };
      const Eigen::Vector2d p_m(sixteenths(31), sixteenths(29));
      const auto rank = [&](std::size_t to) {  // ways to a tenth of a millimetre
        const double squared = (floor.centre(floor.cell(to)) - p_m).squaredNorm();
        return std::pair(squared, std::round(1e4 * drawn.shortest[to]));
      };
      std::pair<double, double> best(kInfinity, kInfinity);
      for (std::size_t to = 0; to < floor.size(); ++to) {
        if (drawn.shortest[to] < kInfinity) best = std::min(best, rank(to));
      }
      const auto from = outlooks.towards(p_m);
      ASSERT_TRUE(from);
      bool leads_there = false;
      for (std::size_t to = 0; to < floor.size(); ++to) {
        if (drawn.shortest[to] == kInfinity || rank(to) != best) continue;
        leads_there = leads_there || drawn.ways[*from][to] < drawn.shortest[to] + 1e-5;
      }
      EXPECT_TRUE(leads_there) << draw << ", point " << i;
    }
  }
}

}  // namespace
}  // namespace vantage
