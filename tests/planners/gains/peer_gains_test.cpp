#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/planners/gains/gain_along.hpp"
#include "vantage/information/discrete.hpp"

namespace vantage {
namespace {

constexpr double kPeerTolerance = 1e-4;  // tables are single precision

/// p(free) of a free cell, its evidence taken from another prior than 0.5.
double clear_from(double opacity_unobserved) {
  const double odds =
      opacity_unobserved / (1.0 - opacity_unobserved) * kFreeCell / (1.0 - kFreeCell);
  return 1.0 / (1.0 + odds);
}

double geometric(double ratio, int terms) { return (1.0 - std::pow(ratio, terms)) / (1.0 - ratio); }

TEST(OcclusionAwareGain, IsAGeometricSeriesInUnobservedSpace) {
  EXPECT_NEAR(along(OcclusionAwareGain{.opacity_unobserved = 0.25}, "??????"), geometric(0.75, 6),
              kPeerTolerance);
  EXPECT_NEAR(along(OcclusionAwareGain{.opacity_unobserved = 0.0}, "??????"), 6.0, kPeerTolerance);
}

TEST(OcclusionAwareGain, CountsKnownCellsTooAndFreeSpaceIsNearlyClear) {
  for (const double q : {0.0, kOpacityUnobserved, 0.25, 0.5}) {
    const double clear = clear_from(q);
    EXPECT_NEAR(along(OcclusionAwareGain{.opacity_unobserved = q}, "..??"),
                kFreeBits * (1.0 + clear) + clear * clear * (1.0 + (1.0 - q)), kPeerTolerance);
  }
}

// Known free cells that no more than one beam passed must not hide what is behind them.
TEST(UnobservedVoxelGain, SeesThroughFreeSpaceOfLittleEvidence) {
  OccupancyGrid row = row_of_cells(std::string(50, '.') + "?");
  for (std::size_t cell = 0; cell < 50; ++cell) {
    row.log_odds[cell] = static_cast<float>(log_odds_of(0.3));
  }
  EXPECT_GT(along(UnobservedVoxelGain{}, row), 0.8);
  EXPECT_NEAR(along(UnobservedVoxelGain{.opacity_unobserved = 0.5}, row), std::pow(0.7, 50), 1e-8);
}

TEST(OcclusionAwareGain, EndsInTheFirstOccupiedCell) {
  EXPECT_NEAR(along(OcclusionAwareGain{.opacity_unobserved = 0.25}, "?#??##"),
              1.0 + 0.75 * kOccupiedBits, kPeerTolerance);
}

TEST(UnobservedVoxelGain, LeavesKnownCellsOut) {
  const double clear = clear_from(0.25);
  EXPECT_NEAR(along(UnobservedVoxelGain{.opacity_unobserved = 0.25}, ".?.?#?"),
              clear + clear * clear * 0.75, kPeerTolerance);
  EXPECT_EQ(along(UnobservedVoxelGain{}, "....#"), 0.0);
}

TEST(RearSideVoxelGain, CountsBeamsThatMeetASurfaceOutOfTheUnknown) {
  EXPECT_EQ(along(RearSideVoxelGain{}, "..??#"), 1.0);
  EXPECT_EQ(along(RearSideVoxelGain{}, "??.#"), 0.0);
  EXPECT_EQ(along(RearSideVoxelGain{}, "????"), 0.0);
  EXPECT_EQ(along(RearSideVoxelGain{}, "#?#"), 0.0);
  EXPECT_EQ(along(RearSideVoxelGain{}, "?#?#"), 1.0);
}

TEST(RearSideEntropyGain, SumsTheRunInFrontOfTheSurfaceAlone) {
  const RearSideEntropyGain gain{.opacity_unobserved = 0.25};
  const double clear = clear_from(0.25);
  EXPECT_NEAR(along(gain, "???#"), geometric(0.75, 3), kPeerTolerance);
  EXPECT_NEAR(along(gain, "?.??#??#"), 0.75 * clear * geometric(0.75, 2), kPeerTolerance);
  EXPECT_EQ(along(gain, "???.#"), 0.0);
  EXPECT_EQ(along(gain, "???"), 0.0);
}

TEST(UnmappedVolumeGain, IsTheSimpleGainInCubicMetres) {
  OccupancyGrid grid = row_of_cells("..??.?#??");
  grid.frame.min_corner_m = {0.0, -0.1, -0.2};
  grid.frame.cell_size_m = {0.5, 0.2, 0.4};
  EXPECT_NEAR(along(UnmappedVolumeGain{}, grid), 3.0 * 0.5 * 0.2 * 0.4, 1e-8);
}

TEST(OddsUpdateBits, IsTheDivergenceOfTheUpdatedFromTheOldOccupancy) {
  for (const double p : {0.02, 0.3, 0.5, 0.9}) {
    for (const double d : {0.1, 0.5, 1.0, 3.0, 20.0}) {
      const double odds = p / (1.0 - p);
      const double updated = d * odds / (1.0 + d * odds);
      const std::array<double, 2> after{updated, 1.0 - updated};
      const std::array<double, 2> before{p, 1.0 - p};
      EXPECT_NEAR(odds_update_bits(d, odds), kl_divergence_bits(after, before), 1e-12);
    }
  }
}

// Two unobserved cells: the first is hit, or the second through the first.
TEST(FsmiGain, AveragesOverTheCellTheBeamMayEndIn) {
  const FsmiGain gain{.opacity_unobserved = 0.5, .d_occ = 4.0, .d_emp = 0.25};
  const double hit = odds_update_bits(4.0, 1.0);
  const double pass = odds_update_bits(0.25, 1.0);
  EXPECT_NEAR(along(gain, "??"), 0.5 * hit + 0.25 * (hit + pass), kPeerTolerance);
}

// Full updates, d_occ -> inf and d_emp -> 0, teach all there is: H of the first cell, and that of
// each further one where the beam gets there.
TEST(FsmiGain, OfAPerfectSensorIsTheEntropyOfTheCellsItReaches) {
  const FsmiGain gain{.opacity_unobserved = 0.5, .d_occ = 1e9, .d_emp = 1e-9};
  EXPECT_NEAR(along(gain, std::string(20, '?')), 2.0, 1e-3);
}

// In front of a wall the beam's end is known: every cell before it is passed.
TEST(FsmiGain, InFrontOfAWallIsWorthAPassPerCell) {
  const FsmiGain gain{.opacity_unobserved = 0.0};
  const double pass = odds_update_bits(gain.d_emp, 1.0);
  EXPECT_NEAR(along(gain, "?????#"), 5.0 * pass, kPeerTolerance);
  EXPECT_EQ(along(gain, "?????"), 0.0);
}

// exp() of such log odds is infinite, or 0.
TEST(FsmiGain, HoldsHoweverCertainTheMapIs) {
  OccupancyGrid row = row_of_cells(".?.?#");
  std::vector<double> bits;
  for (const float log_odds : {60.0F, 709.0F, 710.0F, 1e38F}) {
    row.log_odds[0] = row.log_odds[2] = -log_odds;
    row.log_odds[4] = log_odds;
    bits.push_back(along(FsmiGain{}, row));
    EXPECT_GT(bits.back(), 0.1);
    EXPECT_NEAR(bits.back(), bits.front(), kPeerTolerance) << log_odds;
  }
  EXPECT_EQ(odds_update_bits(4.0, std::numeric_limits<double>::infinity()), 0.0);
}

TEST(FsmiGain, ABeamEndsWhereABillionthOfItIsLeft) {
  const FsmiGain gain{.opacity_unobserved = 0.5};
  const OccupancyGrid row = row_of_cells("?");
  const FsmiGain::Tables tables = gain.prepare({row});
  FsmiGain::Beam beam = gain.beam(tables);
  beam.start();
  int cells = 1;
  while (beam.enter(0)) ++cells;
  EXPECT_EQ(cells, 30) << "2^-29 is 1.9e-9, 2^-30 is 0.9e-9";
}

TEST(FsmiGain, LearnsNothingFromMeasurementsThatChangeNothing) {
  EXPECT_NEAR(along(FsmiGain{.d_occ = 1.0, .d_emp = 1.0}, "..??#"), 0.0, 1e-12);
}

template <class G>
class EveryPeerGain : public testing::Test {};
using PeerGains = testing::Types<OcclusionAwareGain, UnobservedVoxelGain, RearSideVoxelGain,
                                 RearSideEntropyGain, UnmappedVolumeGain, FsmiGain>;
TYPED_TEST_SUITE(EveryPeerGain, PeerGains);

std::string any_row() {
  return *rc::gen::container<std::string>(*rc::gen::inRange<std::size_t>(1, 30),
                                          rc::gen::element('.', '?', '?', '#'));
}

TYPED_TEST(EveryPeerGain, LiesBetweenNothingAndABitPerCell) {
  EXPECT_TRUE(rc::check([] {
    const std::string row = any_row();
    const double gain = along(TypeParam{}, row);
    RC_ASSERT(gain >= 0.0);
    RC_ASSERT(gain <= static_cast<double>(row.size()) + 1e-6);
  }));
}

// The peers' released code multiplies visibility by p(occupied) instead of p(free): then a wall in
// front is a window, and free space a wall. The next two would not hold.
TYPED_TEST(EveryPeerGain, LosesNothingOfNoteToFreeSpaceInFront) {
  EXPECT_TRUE(rc::check([] {
    const std::string row = any_row();
    const std::string free(*rc::gen::inRange<std::size_t>(1, 10), '.');
    const double clear = std::pow(clear_from(kOpacityUnobserved), free.size());
    RC_ASSERT(along(TypeParam{}, free + row) >= clear * along(TypeParam{}, row) - kPeerTolerance);
  }));
}

TYPED_TEST(EveryPeerGain, SeesNothingBehindAWall) {
  EXPECT_TRUE(rc::check([] {
    const std::string row = any_row();
    RC_ASSERT(std::abs(along(TypeParam{}, "#" + row) - along(TypeParam{}, "#")) < kPeerTolerance);
  }));
}

TYPED_TEST(EveryPeerGain, GrowsWithUnknownSpaceInFrontOfAWall) {
  double before = 0.0;
  for (std::size_t cells = 1; cells < 40; ++cells) {
    const double gain = along(TypeParam{}, ".." + std::string(cells, '?') + "#");
    if (TypeParam::name == "rear_side_voxel") {
      EXPECT_EQ(gain, 1.0);
    } else {
      EXPECT_GT(gain, before) << cells;
    }
    before = gain;
  }
}

// Why the opacity of unobserved cells is not the prior.
TEST(UnobservedVoxelGain, WithThePriorAsOpacityCannotTellDepthsApart) {
  const auto depth = [](double opacity, std::size_t cells) {
    return along(UnobservedVoxelGain{.opacity_unobserved = opacity}, std::string(cells, '?'));
  };
  EXPECT_NEAR(depth(0.5, 60), depth(0.5, 20), 1e-4);
  EXPECT_GT(depth(kOpacityUnobserved, 60), 2.0 * depth(kOpacityUnobserved, 20));
}

}  // namespace
}  // namespace vantage
