// The gain of docs/tutorials/own-gain.md is what the page says.
#include <gtest/gtest.h>

#include <string_view>

#include "docs/tutorials/rim_gain.hpp"
#include "tests/planners/gains/gain_along.hpp"

namespace vantage {
namespace {

double rim_along(std::string_view cells, double a) {
  const RimGain gain{.a = a};
  const OccupancyGrid row = row_of_cells(cells);
  return sum_over_view(gain, gain.prepare({row}), row.frame, make_pose({-0.5, 0.0, 0.0}, 0.0),
                       straight_ahead());
}

TEST(RimGain, CountsWhatTouchesASurface) {
  EXPECT_NEAR(rim_along("..??#", 1.0), 1.0, 1e-5) << "the one before the surface";
  EXPECT_NEAR(rim_along("..??#", 0.5), 0.5, 1e-5) << "through one unobserved cell";
  EXPECT_NEAR(rim_along("..????", 1.0), 0.0, 1e-5) << "no surface is known";
  EXPECT_NEAR(rim_along(".#?", 1.0), 0.0, 1e-5) << "hidden";
}

}  // namespace
}  // namespace vantage
