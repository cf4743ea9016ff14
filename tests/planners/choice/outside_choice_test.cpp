#include "vantage/planners/choice/outside_choice.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <tuple>
#include <vector>

#include "tests/planners/navigation/ascii_floor.hpp"

namespace vantage {
namespace {

/// Three views of a robot in the left one of two rooms.
class OutsideDecisions : public testing::Test {
 protected:
  [[nodiscard]] bool is_carried_out(const OutsideDecision& decision) const {
    const DecisionRequest request{.situation = {.grid = grid_,
                                                .transmission = transmission_,
                                                .field_of_view = {},
                                                .T_world_base = {},
                                                .left = {}},
                                  .candidates = views_,
                                  .travel_s = {1.0, 2.0, 3.0},
                                  .gain = gain_,
                                  .paths = paths_,
                                  .own_choice = {}};
    try {
      check_decision(decision, request);
      return true;
    } catch (const BadDecision& error) {
      EXPECT_EQ(error.code(), ExitCode::goal_failed);
      return false;
    }
  }

  OccupancyGrid grid_;
  BlockField transmission_;
  Gain gain_ = SimpleGain{};
  std::vector<Candidate> views_ = std::vector<Candidate>(3);
  PathField paths_ =
      make_path_field(floor_of({"...#...", "S..#..."}), {0.5, 0.5, 0.0}, point_robot());
};

TEST_F(OutsideDecisions, AnIndexIsOfAViewThatMayBeTaken) {
  EXPECT_TRUE(is_carried_out(std::size_t{0}));
  EXPECT_TRUE(is_carried_out(std::size_t{2}));
  EXPECT_FALSE(is_carried_out(std::size_t{3}));
  views_[1].exhausted = true;
  EXPECT_FALSE(is_carried_out(std::size_t{1}));
  EXPECT_TRUE(is_carried_out(std::size_t{2}));
  for (Candidate& view : views_) view.exhausted = true;
  EXPECT_TRUE(is_carried_out(std::size_t{1})) << "none is left that is not";
}

TEST_F(OutsideDecisions, NothingIsTakenOrSpentThatIsNotSaid) {
  const MapSituation situation{.grid = grid_,
                               .transmission = transmission_,
                               .field_of_view = {},
                               .T_world_base = {},
                               .left = {}};
  EXPECT_EQ(situation.scans, 0U);
  EXPECT_EQ(situation.scans_left, 0);
  EXPECT_EQ(situation.time_s, 0.0);
  EXPECT_EQ(situation.energy_j, 0.0);
  EXPECT_EQ(situation.scan_s, 0.0);
  EXPECT_FALSE(OutsideChoice{}.blind);
}

TEST_F(OutsideDecisions, APoseIsOnFloorInReach) {
  EXPECT_TRUE(is_carried_out(Pose2{2.9, 1.9, 7.0}));
  EXPECT_FALSE(is_carried_out(Pose2{3.5, 0.5, 0.0})) << "in the wall";
  EXPECT_FALSE(is_carried_out(Pose2{5.5, 0.5, 0.0})) << "in the other room";
  EXPECT_FALSE(is_carried_out(Pose2{-0.5, 0.5, 0.0})) << "off the map";
  constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  for (const double bad : {kNoNumber, kEndless, -kEndless}) {
    EXPECT_FALSE(is_carried_out(Pose2{bad, 0.5, 0.0}));
    EXPECT_FALSE(is_carried_out(Pose2{0.5, bad, 0.0}));
    EXPECT_FALSE(is_carried_out(Pose2{0.5, 0.5, bad}));
  }
  EXPECT_FALSE(is_carried_out(Pose2{1e300, 0.5, 0.0})) << "no cell has such a number";
  EXPECT_FALSE(is_carried_out(Pose2{0.5, -1e300, 0.0}));
}

TEST(DecisionRequest, AnIntervalHasALowEndAndAHighOne) {
  using Interval = decltype(DecisionRequest::interval_cells)::value_type;
  EXPECT_EQ(std::tuple_size_v<Interval>, 2U);
}

}  // namespace
}  // namespace vantage
