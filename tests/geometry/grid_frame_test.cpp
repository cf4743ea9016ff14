#include "vantage/geometry/grid_frame.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>
#include <utility>

#include "vantage/core/rng.hpp"
#include "vantage/geometry/face_neighbours.hpp"

namespace vantage {
namespace {

GridFrame random_frame(Rng& rng) {
  const auto some = [&] { return 1 + static_cast<int>(rng.uniform_index(12)); };
  return make_grid_frame({rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-2, 2)},
                         {rng.uniform(0.1, 4), rng.uniform(0.1, 4), rng.uniform(0.1, 4)},
                         {some(), some(), some()});
}

TEST(GridFrame, FillsItsBox) {
  const GridFrame frame = make_grid_frame({1.0, 2.0, 3.0}, {2.0, 4.0, 1.0}, {4, 4, 2});
  EXPECT_EQ(frame.size(), 32U);
  EXPECT_TRUE(frame.min_corner_m.isApprox(Eigen::Vector3d(0, 0, 2.5)));
  EXPECT_TRUE(frame.cell_size_m.isApprox(Eigen::Vector3d(0.5, 1.0, 0.5)));
  EXPECT_TRUE(frame.box().max().isApprox(Eigen::Vector3d(2, 4, 3.5)));
  EXPECT_TRUE(frame.centre({0, 0, 0}).isApprox(Eigen::Vector3d(0.25, 0.5, 2.75)));
}

TEST(GridFrame, XRunsFastest) {
  const GridFrame frame = make_grid_frame({0, 0, 0}, {1, 1, 1}, {3, 4, 5});
  EXPECT_EQ(frame.index({1, 0, 0}), 1U);
  EXPECT_EQ(frame.index({0, 1, 0}), 3U);
  EXPECT_EQ(frame.index({0, 0, 1}), 12U);
  EXPECT_EQ(frame.index({2, 3, 4}), frame.size() - 1);
}

RC_GTEST_PROP(GridFrame, IndexCellAndCentreAreInverse, (std::uint64_t seed)) {
  Rng rng(seed);
  const GridFrame frame = random_frame(rng);
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const Eigen::Array3i cell = frame.cell(i);
    RC_ASSERT(frame.contains(cell));
    RC_ASSERT(frame.index(cell) == i);
    RC_ASSERT((frame.cell_at(frame.centre(cell)) == cell).all());
  }
}

TEST(GridFrame, PointsOutsideHaveCellsOutside) {
  const GridFrame frame = make_grid_frame({0, 0, 0}, {2, 2, 2}, {2, 2, 2});
  EXPECT_TRUE(frame.contains(frame.cell_at({-1, -1, -1})));
  EXPECT_FALSE(frame.contains(frame.cell_at({1, 0, 0})));  // half-open above
  EXPECT_FALSE(frame.contains(frame.cell_at({-1.001, 0, 0})));
  EXPECT_FALSE(frame.contains(frame.cell_at({0, 0, 7})));
}

TEST(GridFrameDeathTest, NeedsCellsAndSize) {
  EXPECT_DEATH(make_grid_frame({0, 0, 0}, {1, 1, 1}, {1, 0, 1}), "needs cells");
  EXPECT_DEATH(make_grid_frame({0, 0, 0}, {1, 0, 1}, {1, 1, 1}), "needs cells");
}

const Eigen::AlignedBox3d kUnit(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 1, 1));

TEST(ClipSegment, KnownCases) {
  const auto through = clip_segment(kUnit, {-1, 0.5, 0.5}, {3, 0.5, 0.5});
  EXPECT_DOUBLE_EQ(through.enter, 0.25);
  EXPECT_DOUBLE_EQ(through.leave, 0.5);
  const auto inside = clip_segment(kUnit, {0.1, 0.1, 0.1}, {0.9, 0.9, 0.9});
  EXPECT_EQ(inside.enter, 0.0);
  EXPECT_EQ(inside.leave, 1.0);
  const auto ends_inside = clip_segment(kUnit, {-1, 0.5, 0.5}, {0.5, 0.5, 0.5});
  EXPECT_NEAR(ends_inside.enter, 2.0 / 3.0, 1e-15);
  EXPECT_EQ(ends_inside.leave, 1.0);
}

TEST(ClipSegment, Misses) {
  EXPECT_TRUE(clip_segment(kUnit, {-1, 2, 0.5}, {3, 2, 0.5}).empty());          // parallel, beside
  EXPECT_TRUE(clip_segment(kUnit, {-2, 0.5, 0.5}, {-1, 0.5, 0.5}).empty());     // too short
  EXPECT_TRUE(clip_segment(kUnit, {2, 0.5, 0.5}, {3, 0.5, 0.5}).empty());       // behind
  EXPECT_TRUE(clip_segment(kUnit, {-1, 0.5, 0.5}, {0.5, 2.5, 0.5}).empty());    // past a corner
  EXPECT_TRUE(clip_segment(kUnit, {2, 2, 2}, {2, 2, 2}).empty());               // a point
  EXPECT_FALSE(clip_segment(kUnit, {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}).empty());  // a point inside
}

TEST(ClipSegment, AFaceBelongsToTheBox) {
  for (const double y : {0.0, 1.0}) {
    const auto along = clip_segment(kUnit, {-1, y, 0.25}, {3, y, 0.25});
    EXPECT_DOUBLE_EQ(along.enter, 0.25);
    EXPECT_DOUBLE_EQ(along.leave, 0.5);
    EXPECT_FALSE(along.empty());
  }
  EXPECT_FALSE(clip_segment(kUnit, {-1, 0.5, 0.25}, {0, 0.5, 0.25}).empty()) << "it ends on one";
  EXPECT_TRUE(clip_segment(kUnit, {-1, -1e-9, 0.25}, {3, -1e-9, 0.25}).empty());
  EXPECT_TRUE(clip_segment(kUnit, {-1, 1.0 + 1e-9, 0.25}, {3, 1.0 + 1e-9, 0.25}).empty());
}

TEST(GridFrame, IsOneCellOfOneMetreAtFirst) {
  EXPECT_EQ(GridFrame{}.size(), 1U);
  EXPECT_TRUE(GridFrame{}.box().max().isApprox(Eigen::Vector3d::Ones()));
  EXPECT_EQ(GridFrame{}.min_corner_m, Eigen::Vector3d(0, 0, 0));
}

TEST(GridFrame, ContainsItsCellsAndNoOthers) {
  const GridFrame frame = make_grid_frame({0, 0, 0}, {3, 4, 5}, {3, 4, 5});
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Array3i cell(1, 1, 1);
    for (const auto& [at, expected] :
         {std::pair{-1, false}, {0, true}, {axis + 2, true}, {axis + 3, false}}) {
      cell[axis] = at;
      EXPECT_EQ(frame.contains(cell), expected) << axis << " " << at;
    }
  }
}

TEST(AnyFaceNeighbour, AsksThoseThatShareAFaceAndNoOthers) {
  const GridFrame frame = make_grid_frame({0, 0, 0}, {3, 4, 5}, {3, 4, 5});
  for (std::size_t i = 0; i < frame.size(); ++i) {
    std::set<std::size_t> expected;
    for (std::size_t k = 0; k < frame.size(); ++k) {
      if ((frame.cell(i) - frame.cell(k)).abs().sum() == 1) expected.insert(k);
    }
    std::set<std::size_t> asked;
    std::size_t times = 0;
    EXPECT_FALSE(any_face_neighbour(frame, frame.cell(i), [&](std::size_t k) {
      asked.insert(k);
      ++times;
      return false;
    }));
    EXPECT_EQ(asked, expected) << i;
    EXPECT_EQ(times, expected.size()) << i;
    for (const std::size_t one : expected) {
      EXPECT_TRUE(
          any_face_neighbour(frame, frame.cell(i), [&](std::size_t k) { return k == one; }));
    }
  }
}

RC_GTEST_PROP(ClipSegment, PartInsideIsInside, (std::uint64_t seed)) {
  Rng rng(seed);
  const auto corner = [&] {
    return Eigen::Vector3d(rng.uniform(-2, 3), rng.uniform(-2, 3), rng.uniform(-2, 3));
  };
  const Eigen::Vector3d p0 = corner();
  const Eigen::Vector3d p1 = corner();
  const SegmentClip clip = clip_segment(kUnit, p0, p1);
  for (double t = 0.0; t <= 1.0; t += 0.01) {
    const Eigen::Vector3d p = p0 + t * (p1 - p0);
    if (std::abs(t - clip.enter) < 1e-9 || std::abs(t - clip.leave) < 1e-9) continue;
    const bool expected = !clip.empty() && t > clip.enter && t < clip.leave;
    RC_ASSERT(kUnit.contains(p) == expected);
  }
}

TEST(ClipSegment, AlongAnAxisTheOthersCountToo) {
  const auto up = clip_segment(kUnit, {0.5, 0.5, -1}, {0.5, 0.5, 3});
  EXPECT_DOUBLE_EQ(up.enter, 0.25);
  EXPECT_DOUBLE_EQ(up.leave, 0.5);
  const auto left = clip_segment(kUnit, {0.5, -1, 0.5}, {0.5, 3, 0.5});
  EXPECT_DOUBLE_EQ(left.enter, 0.25);
  EXPECT_DOUBLE_EQ(left.leave, 0.5);
  EXPECT_TRUE(clip_segment(kUnit, {0.5, -1, 2}, {0.5, 3, 2}).empty());
}

TEST(ClipSegment, OfAMissNothingIsLeft) {
  const auto beside = clip_segment(kUnit, {-1, 2, 0.5}, {3, 2, 0.5});
  EXPECT_EQ(beside.enter, 1.0);
  EXPECT_EQ(beside.leave, 0.0);
  EXPECT_EQ(SegmentClip{}.enter, 0.0);
  EXPECT_EQ(SegmentClip{}.leave, 1.0);
}

}  // namespace
}  // namespace vantage
