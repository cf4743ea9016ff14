// Where a camera turns that has no object to look at.
#include "vantage/planners/trajectory/search_heading.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vantage {
namespace {

constexpr double kFov_rad = 0.995;

/// 6 x 6 m round the vehicle, one layer 0.9 m below it; all of it seen and free.
class Search : public testing::Test {
 protected:
  Search() : grid_(GridFrame{{-3.0, -3.0, 0.8}, {0.1, 0.1, 0.2}, {60, 60, 1}}) {
    for (float& odds : grid_.log_odds) odds = -2.0F;
  }
  /// Everything in a box, level.
  void set(double x0, double x1, double y0, double y1, float log_odds) {
    for (std::size_t cell = 0; cell < grid_.size(); ++cell) {
      const Eigen::Vector3d p = grid_.frame.centre(grid_.frame.cell(cell));
      if (p.x() > x0 && p.x() < x1 && p.y() > y0 && p.y() < y1) grid_.log_odds[cell] = log_odds;
    }
  }
  [[nodiscard]] std::optional<double> heading(double ahead_rad = 0.0) const {
    return search_heading(options_, grid_, {0.0, 0.0, 1.8}, ahead_rad, kFov_rad);
  }

  OccupancyGrid grid_;
  SearchOptions options_;
};

TEST_F(Search, TurnsToWhatWasNotSeen) {
  EXPECT_FALSE(heading()) << "all was seen";
  set(0.4, 1.6, 0.8, 2.0, 0.0F);
  const auto left = heading();
  ASSERT_TRUE(left);
  EXPECT_GT(*left, 0.4);
  EXPECT_LE(*left, options_.turn_rad + 1e-9);
  EXPECT_FALSE(heading(-2.5)) << "it is behind";
}

TEST_F(Search, LooksAheadWhenMostIsThere) {
  set(0.6, 2.5, -0.8, 0.8, 0.0F);
  set(-0.2, 0.2, 0.8, 1.6, 0.0F);
  EXPECT_FALSE(heading());
}

TEST_F(Search, DoesNotSeeBehindWhatStandsThere) {
  set(0.4, 1.6, 1.0, 2.2, 0.0F);
  set(-0.2, 2.2, 0.7, 0.9, 2.0F);
  EXPECT_FALSE(heading());
}

TEST_F(Search, AWaypointLooksAtTheMiddleOfWhatItTurnsTo) {
  set(0.4, 1.6, 0.8, 2.0, 0.0F);
  Eigen::Matrix4Xd path = Eigen::Matrix4Xd::Zero(4, 2);
  path.row(2).setConstant(1.8);
  path(0, 1) = 1.0;
  const FlightCamera camera{.T_body_camera = camera_ahead(0.6)};
  const auto target = search_target(options_, grid_, camera, path, 0, 1.2);
  ASSERT_TRUE(target);
  Eigen::Vector4d turned = path.col(0);
  turned[3] = *heading();
  const auto v = in_frame(camera, turned, target->p_world_object_m);
  ASSERT_TRUE(v);
  EXPECT_NEAR(v->norm(), 0.0, 1e-9);
  EXPECT_EQ(target->entropy_nats, 0.0) << "nothing to fly to";
  EXPECT_FALSE(target->flown_to);
}

TEST_F(Search, TurnsForEnoughAlone) {
  set(0.4, 1.6, 0.8, 2.0, 0.0F);
  options_.min_area_m2 = 5.0;
  EXPECT_FALSE(heading());
  options_ = {.turn_rad = 0.0};
  EXPECT_FALSE(heading()) << "it may not";
}

TEST_F(Search, LooksNoFartherThanTheGrid) {
  set(-3.0, -1.5, 0.6, 1.8, 0.0F);  // at the other end of the rows that it looks along
  EXPECT_FALSE(search_heading(options_, grid_, {2.0, 0.0, 1.8}, 0.0, kFov_rad));
}

TEST_F(Search, LooksFromHalfAMetreOn) {
  set(0.0, 0.3, 0.1, 0.3, 0.0F);
  options_.min_area_m2 = 0.0;
  EXPECT_FALSE(heading()) << "what is nearer is below the frame";
  set(0.3, 0.6, 0.5, 0.7, 0.0F);
  options_.min_area_m2 = 0.01;
  EXPECT_TRUE(heading());
}

/// Ahead, then to the left, which is where the last one looks from as well.
TEST_F(Search, AWaypointLooksRoundTheWayOnFromThere) {
  set(-0.5, 0.5, 0.6, 2.2, 0.0F);
  options_.min_area_m2 = 0.1;
  Eigen::Matrix4Xd path = Eigen::Matrix4Xd::Zero(4, 3);
  path.topRows<3>() << 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.8, 1.8, 1.8;
  const FlightCamera camera{.T_body_camera = camera_ahead(0.6)};
  for (const Eigen::Index i : {0, 1, 2}) {
    const auto yaw_rad = search_heading(options_, grid_, path.col(i).head<3>(),
                                        i == 0 ? 0.0 : M_PI / 2.0, camera.horizontal_fov_rad);
    const auto target = search_target(options_, grid_, camera, path, i, 1.2);
    ASSERT_TRUE(yaw_rad && target) << i;
    const Eigen::Vector3d to_m = target->p_world_object_m - path.col(i).head<3>();
    EXPECT_NEAR(std::atan2(to_m.y(), to_m.x()), *yaw_rad, 1e-9) << i;
    EXPECT_EQ(target->p_world_view_m, path.col(i).head<3>()) << i;
  }
}

constexpr double kBetweenRays_rad = M_PI / 36.0;

/// Nothing was seen of a strip 1.7 to 2.4 m away that one ray alone crosses: it turns no farther
/// than to have that at the rim of the image, eleven rays wide.
class Strip : public Search {
 protected:
  void leave_unseen(int ray) {
    const double bearing_rad = ray * kBetweenRays_rad;
    for (const double away_m : {1.7, 1.8, 1.9, 2.0, 2.1, 2.2, 2.3, 2.4}) {
      const Eigen::Vector3d p(away_m * std::cos(bearing_rad), away_m * std::sin(bearing_rad), 0.9);
      grid_.log_odds[grid_.frame.index(grid_.frame.cell_at(p))] = 0.0F;
    }
  }
  [[nodiscard]] double turned_by(double min_area_m2) const {
    return search_heading({.turn_rad = 1.0, .min_area_m2 = min_area_m2}, grid_, {0.0, 0.0, 1.8},
                          0.0, kFov_rad)
        .value_or(0.0);
  }
};

TEST_F(Strip, TheLeastTurnThatShowsItIsTaken) {
  leave_unseen(10);
  EXPECT_NEAR(turned_by(0.05), 5.0 * kBetweenRays_rad, 1e-9);
  // The lengths of the arcs between rays, 0.1 m deep, less for the turn.
  const double area_m2 = 16.4 * kBetweenRays_rad * 0.1;
  const double utility_m2 = area_m2 * std::cos(2.5 * kBetweenRays_rad);
  EXPECT_NEAR(turned_by(utility_m2 - 1e-6), 5.0 * kBetweenRays_rad, 1e-9);
  EXPECT_EQ(turned_by(utility_m2 + 1e-6), 0.0);
}

TEST_F(Strip, RaysStepByTheShorterEdgeOfACell) {
  grid_ = OccupancyGrid(GridFrame{{-3.0, -3.0, 0.8}, {0.1, 0.05, 0.2}, {60, 120, 1}});
  std::ranges::fill(grid_.log_odds, -2.0F);
  leave_unseen(10);
  double area_m2 = 0.0;
  const double bearing_rad = 10 * kBetweenRays_rad;
  for (double away_m = 0.5; away_m < options_.range_m; away_m += 0.05) {
    const Eigen::Vector3d p(away_m * std::cos(bearing_rad), away_m * std::sin(bearing_rad), 0.9);
    const auto state = grid_.state(grid_.frame.index(grid_.frame.cell_at(p)));
    if (state == CellState::unobserved) area_m2 += away_m * kBetweenRays_rad * 0.05;
  }
  ASSERT_GT(area_m2, 0.05);
  const double utility_m2 = area_m2 * std::cos(2.5 * kBetweenRays_rad);
  EXPECT_NEAR(turned_by(utility_m2 - 1e-6), 5.0 * kBetweenRays_rad, 1e-9);
  EXPECT_EQ(turned_by(utility_m2 + 1e-6), 0.0);
}

TEST_F(Strip, ItTurnsToEitherSideAsFarAsItMay) {
  leave_unseen(16);
  EXPECT_NEAR(turned_by(0.05), 11.0 * kBetweenRays_rad, 1e-9) << "just less than a radian";
  std::ranges::fill(grid_.log_odds, -2.0F);
  leave_unseen(17);
  EXPECT_EQ(turned_by(0.05), 0.0);
  leave_unseen(-10);
  EXPECT_NEAR(turned_by(0.05), -5.0 * kBetweenRays_rad, 1e-9);
}

}  // namespace
}  // namespace vantage
