// Poses in passages of a robot that covers one cell of 1 cm.
#include "vantage/planners/navigation/narrow_poses.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "tests/planners/navigation/drawn_rooms.hpp"

namespace vantage {
namespace {

class PosesOfOneCell : public testing::Test {
 protected:
  /// All of a room of 2 x 2 m is a passage, with posts in some cells.
  NarrowPoses poses(const std::vector<Eigen::Array2i>& posts) {
    DrawnRooms rooms(2.0, 2.0, {});
    for (const Eigen::Array2i& post : posts) {
      rooms.detail.log_odds[rooms.detail.index(post)] = 3.0F;
    }
    field_.map = rooms.floor;
    field_.space = rooms.space({.outline = rectangle(0.008, 0.008)},
                               {.margin_m = 0.001, .preferred_margin_m = 0.0, .headings = 4});
    return {field_, std::vector<Leeway>(field_.map.size(), Leeway::passage)};
  }

  PathField field_;
};

TEST_F(PosesOfOneCell, FitBetweenTwoOfThemInOneOfBothMiddleCells) {
  using Fits = std::pair<bool, bool>;  // at all, and roomily
  for (const bool along_x : {false, true}) {
    for (const int side : {-1, 1}) {
      const auto at = [&](int steps) -> Eigen::Array2i {
        return {100 + (along_x ? side * steps : 0), 100 + (along_x ? 0 : side * steps)};
      };
      const auto fits = [&](const std::vector<Eigen::Array2i>& posts) {
        const NarrowPoses there = poses(posts);
        return Fits(there.fits_between(at(0), at(5), 0), there.is_roomy_between(at(0), at(5), 0));
      };
      EXPECT_EQ(fits({at(0), at(1), at(4), at(5)}), Fits(true, true));
      EXPECT_EQ(fits({at(2)}), Fits(true, false));
      EXPECT_EQ(fits({at(3)}), Fits(true, false));
      EXPECT_EQ(fits({at(2), at(3)}), Fits(false, false));
    }
  }
}

TEST_F(PosesOfOneCell, TurnInTheMiddleBetweenBothPlaces) {
  using Fits = std::pair<bool, bool>;
  const auto fits = [&](const Eigen::Array2i& post, bool from_roomy, bool to_roomy) {
    const NarrowPoses there = poses({post});
    const NarrowPoses::Place from{{100, 100}, 0, from_roomy};
    const NarrowPoses::Place to{{104, 102}, 1, to_roomy};
    return Fits(there.fits_turning(from, to), there.is_roomy_turning(from, to));
  };
  EXPECT_EQ(fits({102, 101}, true, true), Fits(false, false));
  EXPECT_EQ(fits({100, 100}, true, true), Fits(true, true));
  EXPECT_EQ(fits({104, 102}, true, true), Fits(true, true));
  EXPECT_EQ(fits({104, 102}, false, true), Fits(true, false));
  EXPECT_EQ(fits({104, 102}, true, false), Fits(true, false));
}

TEST_F(PosesOfOneCell, ThatOfTheStartIsTheOneOfItsCellAndHeading) {
  NarrowPoses there = poses({});
  field_.start = {1.02, 1.03, 1.5};
  field_.start_cell = field_.map.index({20, 20});
  const std::uint32_t start = there.add_start();
  EXPECT_EQ(field_.narrow.at(start).pose.x_m, 1.02) << "where it is, not in the middle of a cell";
  EXPECT_EQ(field_.narrow.at(start).pose.y_m, 1.03);
  EXPECT_EQ(field_.narrow.at(start).pose.yaw_rad, 1.5);
  EXPECT_EQ(field_.narrow.at(start).cell, field_.start_cell);
  EXPECT_TRUE((there.place(start).fine == Eigen::Array2i(102, 102)).all());
  EXPECT_EQ(there.place(start).heading, 1);
  EXPECT_TRUE(there.place(start).roomy);
  EXPECT_EQ(there.at(field_.start_cell, 1), start);
  EXPECT_NE(there.at(field_.start_cell, 0), start);
  EXPECT_EQ(field_.narrow.size(), 2U);
}

}  // namespace
}  // namespace vantage
