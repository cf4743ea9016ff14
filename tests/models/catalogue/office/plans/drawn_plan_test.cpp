// Buildings whose walls are drawn, over many seeds.
#include "vantage/models/catalogue/office/plans/drawn_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

namespace vantage {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

constexpr std::uint64_t kSeeds = 60;

AlignedBox2d shrunk(const AlignedBox2d& box, double by_m) {
  return {box.min() + Vector2d::Constant(by_m), box.max() - Vector2d::Constant(by_m)};
}

/// Parts of both that are not only edges.
bool overlap(const AlignedBox2d& a, const AlignedBox2d& b) {
  return shrunk(a, 1e-6).intersects(shrunk(b, 1e-6));
}

std::vector<AlignedBox2d> all_pieces(const FloorPlan& plan) {
  std::vector<AlignedBox2d> pieces;
  for (const Wall& wall : plan.walls) {
    for (const AlignedBox2d& piece : wall_pieces(wall)) pieces.push_back(piece);
  }
  return pieces;
}

/// The doors of walls by the two coordinates of their middles.
std::vector<Vector2d> doors(const FloorPlan& plan) {
  std::vector<Vector2d> middles;
  for (const Wall& wall : plan.walls) {
    for (const Vector2d& p : thresholds(wall, 0.0)) middles.push_back(p);
  }
  return middles;
}

class DrawnPlan : public testing::TestWithParam<bool> {
 protected:
  static FloorPlan drawn(std::uint64_t seed) {
    return GetParam() ? drawn_large_office(seed) : drawn_small_office(seed);
  }
};

TEST_P(DrawnPlan, WallsAndRoomsCoverTheOfficeOnce) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const FloorPlan plan = drawn(seed);
    for (std::size_t i = 0; i < plan.rooms.size(); ++i) {
      const AlignedBox2d& area = plan.rooms[i].area_m;
      EXPECT_GT(area.sizes().minCoeff(), 1.9) << seed;
      for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(overlap(area, plan.rooms[j].area_m)) << seed;
      for (const AlignedBox2d& piece : all_pieces(plan)) EXPECT_FALSE(overlap(area, piece)) << seed;
    }
    for (double x = -plan.size_m.x() / 2 + 0.13; x < plan.size_m.x() / 2; x += 0.31) {
      for (double y = -plan.size_m.y() / 2 + 0.11; y < plan.size_m.y() / 2; y += 0.29) {
        const Vector2d p(x, y);
        const auto holds = [&](const AlignedBox2d& box) {
          return box.exteriorDistance(p) <= kWallThickness_m;
        };
        EXPECT_TRUE(std::ranges::any_of(plan.rooms, holds, &Room::area_m)) << seed << ": " << x;
      }
    }
  }
}

/// Nothing stands in a door or before it: no wall that meets this one, no pillar.
TEST_P(DrawnPlan, DoorWaysAreFree) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const FloorPlan plan = drawn(seed);
    for (const Wall& wall : plan.walls) {
      for (const AlignedBox2d& way : door_ways(wall, 0.9)) {
        for (const AlignedBox2d& pillar : plan.pillars) EXPECT_FALSE(overlap(way, pillar)) << seed;
        for (const AlignedBox2d& piece : all_pieces(plan)) {
          EXPECT_FALSE(overlap(shrunk(way, 0.01), piece)) << seed;
        }
      }
    }
  }
}

TEST_P(DrawnPlan, EachRoomHasADoor) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const FloorPlan plan = drawn(seed);
    for (const Room& room : plan.rooms) {
      EXPECT_TRUE(std::ranges::any_of(
          doors(plan),
          [&](const Vector2d& p) { return room.area_m.exteriorDistance(p) <= kHalfWall_m + 1e-9; }))
          << seed << ": " << room.area_m.center().transpose();
    }
  }
}

TEST_P(DrawnPlan, IsOfItsSeedAlone) {
  std::set<double> first_doors;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    first_doors.insert(doors(drawn(seed)).front().y());
    EXPECT_EQ(doors(drawn(seed)), doors(drawn(seed)));
  }
  EXPECT_EQ(first_doors.size(), kSeeds);
}

INSTANTIATE_TEST_SUITE_P(Offices, DrawnPlan, testing::Bool(),
                         [](const auto& info) { return info.param ? "large" : "small"; });

/// By where the two open-plan rooms are.
TEST(DrawnLargeOffice, EastMayBeWestAndNorthSouth) {
  std::set<std::pair<bool, bool>> seen;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const FloorPlan plan = drawn_large_office(seed);
    const auto open = std::ranges::find(plan.rooms, RoomUse::open_plan, &Room::use);
    ASSERT_NE(open, plan.rooms.end());
    const Vector2d middle = open->area_m.center();
    seen.insert({middle.x() > 0.0, middle.y() > 0.0});
  }
  EXPECT_EQ(seen.size(), 4U);
}

}  // namespace
}  // namespace vantage
