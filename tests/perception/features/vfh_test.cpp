#include "vantage/perception/features/vfh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/object_views.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

constexpr int kSizeBlock = 135;
constexpr int kViewBlock = 180;

/// What PCL 1.13 computes of 397 points with normals; VANTAGE_ORACLES names the folder it is in,
/// which is beside the repository otherwise.
fs::path oracle(const std::string& file) {
  const char* folder = std::getenv("VANTAGE_ORACLES");
  const fs::path root =
      folder != nullptr ? fs::path(folder) : fs::path(VANTAGE_SOURCE_DIR) / "../shared/oracles";
  return root / "vfh" / file;
}

std::vector<double> numbers_in(const std::string& file) {
  std::ifstream stream(oracle(file));
  std::vector<double> numbers;
  for (double x = 0.0; stream >> x;) numbers.push_back(x);
  return numbers;
}

class VfhOracle : public testing::Test {
 protected:
  void SetUp() override {
    const auto rows = numbers_in("bun0_normals_k10.txt");
    if (rows.empty()) GTEST_SKIP() << "no oracle at " << oracle("bun0_normals_k10.txt");
    ASSERT_EQ(rows.size(), 397U * 7U);  // x y z nx ny nz curvature
    for (std::size_t i = 0; i < rows.size(); i += 7) {
      cloud_.points.emplace_back(rows[i], rows[i + 1], rows[i + 2]);
      cloud_.normals.emplace_back(rows[i + 3], rows[i + 4], rows[i + 5]);
    }
  }
  [[nodiscard]] Eigen::VectorXf ours(VfhSizes sizes) const {
    return viewpoint_feature_histogram(cloud_, Eigen::Vector3d::Zero(), sizes);
  }
  /// A point at a bin's edge may fall on its other side, in single precision.
  static void expect_near(const Eigen::VectorXf& histogram, const std::string& file, int from,
                          int to) {
    const auto expected = numbers_in(file);
    ASSERT_EQ(expected.size(), 308U);
    for (int i = from; i < to; ++i) {
      EXPECT_NEAR(histogram[i], expected[static_cast<std::size_t>(i)], 0.26) << "bin " << i;
    }
  }
  PointCloud cloud_;
};

TEST_F(VfhOracle, AnglesAsPcl) {
  expect_near(ours(VfhSizes::none), "bun0_vfh_mode0.txt", 0, kViewBlock);
}

TEST_F(VfhOracle, AnglesAndSizesAsPcl) {
  expect_near(ours(VfhSizes::metres), "bun0_vfh_mode1.txt", 0, kViewBlock);
}

// PCL divides the line of sight by sqrt(|c|^2 + 1), c the centroid, where |c| is meant. Counted its
// way, the normals give its block; ours is counted with a line of sight of unit length.
TEST_F(VfhOracle, AsPclButForItsLineOfSight) {
  const auto expected = numbers_in("bun0_vfh_mode0.txt");
  ASSERT_EQ(expected.size(), 308U);
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();
  for (const auto& p : cloud_.points) centre += p / 397.0F;
  const auto counted = [&](float length) {
    Eigen::VectorXf bins = Eigen::VectorXf::Zero(128);
    for (const auto& n : cloud_.normals) {
      const float share = (1.0F - n.dot(centre) / length) / 2.0F;
      bins[std::clamp(static_cast<int>(128.0F * share), 0, 127)] += 100.0F / 397.0F;
    }
    return bins;
  };
  const Eigen::VectorXf theirs = counted(std::sqrt(centre.squaredNorm() + 1.0F));
  const Eigen::VectorXf right = counted(centre.norm());
  const Eigen::VectorXf histogram = ours(VfhSizes::none);
  for (int i = 0; i < 128; ++i) {
    EXPECT_NEAR(theirs[i], expected[static_cast<std::size_t>(kViewBlock + i)], 0.26) << i;
    EXPECT_NEAR(histogram[kViewBlock + i], right[i], 0.26) << i;
  }
}

// PCL divides distances by sqrt(d_max^2 + 1) where d_max is meant. Counted its way, the points give
// its block; ours fills the block up to its last bin, and nothing else differs.
TEST_F(VfhOracle, AsPclButForItsNormalisedDistances) {
  const auto expected = numbers_in("bun0_vfh_mode2.txt");
  ASSERT_EQ(expected.size(), 308U);
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();
  for (const auto& p : cloud_.points) centre += p / 397.0F;
  float d_max = 0.0F;
  for (const auto& p : cloud_.points) d_max = std::max(d_max, (p - centre).norm());
  std::vector<double> theirs(45, 0.0);
  for (const auto& p : cloud_.points) {
    const float share = (p - centre).norm() / std::sqrt(d_max * d_max + 1.0F);
    theirs[static_cast<std::size_t>(45.0F * share)] += 100.0 / 396.0;
  }
  for (std::size_t i = 0; i < 45; ++i) EXPECT_NEAR(theirs[i], expected[kSizeBlock + i], 0.26);
  const Eigen::VectorXf histogram = ours(VfhSizes::relative);
  expect_near(histogram, "bun0_vfh_mode2.txt", 0, kSizeBlock);
  EXPECT_GT(histogram[kSizeBlock + 44], 0.0F);
}

/// A square plate, its normals towards the viewpoint, 1 m in front of it.
PointCloud plate() {
  PointCloud cloud;
  for (int i = -5; i <= 5; ++i) {
    for (int j = -5; j <= 5; ++j) {
      cloud.points.emplace_back(0.01F * static_cast<float>(i), 0.01F * static_cast<float>(j), 1.0F);
      cloud.normals.emplace_back(0.0F, 0.0F, -1.0F);
    }
  }
  return cloud;
}

// All normals are alike and across every line from the centroid: the three angles are 0, in the
// middle bin. The centroid itself is a point, and forms no pair.
TEST(Vfh, OfAPlate) {
  const Eigen::VectorXf histogram =
      viewpoint_feature_histogram(plate(), Eigen::Vector3d::Zero(), VfhSizes::metres);
  for (const int block : {0, 45, 90}) {
    EXPECT_NEAR(histogram[block + 22], 100.0, 1e-3) << block;
    EXPECT_NEAR(histogram.segment(block, 45).sum(), 100.0, 1e-3);
  }
  EXPECT_NEAR(histogram[kViewBlock + 127], 100.0, 1e-3);
  EXPECT_NEAR(histogram[kSizeBlock + 5], 100.0 * 28 / 120, 1e-3);  // 4.5 cm .. 5.5 cm
  EXPECT_NEAR(histogram.segment(kSizeBlock, 45).sum(), 100.0, 1e-3);
}

TEST(Vfh, RelativeSizesFillTheirBlock) {
  const Eigen::VectorXf histogram =
      viewpoint_feature_histogram(plate(), Eigen::Vector3d::Zero(), VfhSizes::relative);
  EXPECT_NEAR(histogram[kSizeBlock + 44], 100.0 * 4 / 120, 1e-3);  // the four corners
}

TEST(Vfh, SizesDoNotMatterWithoutTheirBlock) {
  PointCloud twice = plate();
  for (auto& p : twice.points) p *= 2.0F;
  EXPECT_EQ(viewpoint_feature_histogram(plate(), Eigen::Vector3d::Zero(), VfhSizes::none),
            viewpoint_feature_histogram(twice, Eigen::Vector3d::Zero(), VfhSizes::none));
}

TEST(Vfh, PointsWithoutANormalAreLeftOut) {
  PointCloud more = plate();
  more.points.emplace_back(5.0F, 5.0F, 5.0F);
  more.normals.emplace_back(0.0F, 0.0F, 0.0F);
  EXPECT_EQ(viewpoint_feature_histogram(more, Eigen::Vector3d::Zero(), VfhSizes::metres),
            viewpoint_feature_histogram(plate(), Eigen::Vector3d::Zero(), VfhSizes::metres));
}

TEST(Vfh, OfAView) {
  Rng rng(1);
  ObjectView view = ball_view(100, {.radius_m = 0.07}, rng);
  const FeatureResult result = Vfh{}.extract(view);
  ASSERT_TRUE(result.extracted());
  EXPECT_EQ(result.vector.size(), 308);
  EXPECT_NEAR(result.vector.squaredNorm(), 1.0, 1e-4);
  EXPECT_TRUE(result.vector.segment(kSizeBlock, 45).isZero());
  std::ranges::fill(view.depth_m, 0.0F);
  EXPECT_FALSE(Vfh{}.extract(view).extracted());
}

/// Two points with normals that lean by 0.5 rad, seen from the origin; 308 bins, those named
/// filled.
void expect_bins(const std::vector<Eigen::Vector3f>& points,
                 const std::vector<Eigen::Vector3f>& normals,
                 const std::vector<std::pair<int, double>>& filled_bins) {
  PointCloud cloud;
  cloud.points = points;
  cloud.normals = normals;
  Eigen::VectorXf expected = Eigen::VectorXf::Zero(308);
  for (const auto& [bin, share] : filled_bins) expected[bin] += static_cast<float>(share);
  const Eigen::VectorXf histogram =
      viewpoint_feature_histogram(cloud, Eigen::Vector3d::Zero(), VfhSizes::metres);
  for (int i = 0; i < 308; ++i) EXPECT_NEAR(histogram[i], expected[i], 1e-3F) << "bin " << i;
}

constexpr float kLeanSin = 0.479425539F;
constexpr float kLeanCos = 0.877582562F;

// Outwards: the angle to the mean normal is 0.5, that of the line to the normal has sine 0.479.
TEST(Vfh, OfNormalsThatLeanOutwards) {
  expect_bins({{0.1F, 0.0F, 1.0F}, {-0.1F, 0.0F, 1.0F}},
              {{kLeanSin, 0.0F, -kLeanCos}, {-kLeanSin, 0.0F, -kLeanCos}},
              {{26, 200.0},
               {45 + 22, 200.0},
               {90 + 19, 200.0},
               {kSizeBlock + 10, 200.0},
               {kViewBlock + 120, 100.0}});
}

// Aside: only the second angle is not in the middle.
TEST(Vfh, OfNormalsThatLeanAside) {
  expect_bins({{0.1F, 0.0F, 1.0F}, {-0.1F, 0.0F, 1.0F}},
              {{0.0F, kLeanSin, -kLeanCos}, {0.0F, -kLeanSin, -kLeanCos}},
              {{22, 200.0},
               {45 + 25, 200.0},
               {90 + 22, 200.0},
               {kSizeBlock + 10, 200.0},
               {kViewBlock + 120, 100.0}});
}

// 60 cm from their centroid.
TEST(Vfh, DistancesFrom44CentimetresOnShareTheLastBin) {
  expect_bins({{0.6F, 0.0F, 1.0F}, {-0.6F, 0.0F, 1.0F}},
              {{0.0F, kLeanSin, -kLeanCos}, {0.0F, -kLeanSin, -kLeanCos}},
              {{22, 200.0},
               {45 + 25, 200.0},
               {90 + 22, 200.0},
               {kSizeBlock + 44, 200.0},
               {kViewBlock + 120, 100.0}});
}

// The nearer point's line goes with its own normal best, the farther one's with the mean normal.
TEST(Vfh, TheNormalNearerToTheLineComesFirst) {
  expect_bins({{0.1F, 0.0F, 0.9F}, {-0.1F, 0.0F, 1.1F}},
              {{kLeanSin, 0.0F, -kLeanCos}, {-kLeanSin, 0.0F, -kLeanCos}},
              {{26, 200.0},
               {45 + 22, 200.0},
               {90 + 15, 100.0},
               {90 + 18, 100.0},
               {kSizeBlock + 14, 200.0},
               {kViewBlock + 120, 100.0}});
}

TEST(Vfh, SaysHowManyPointsHaveANormal) {
  ObjectView view = blank_view(40, 40);
  for (int column = 0; column < 40; ++column) {
    view.mask[view.index(20, column)] = 1;
    view.depth_m[view.index(20, column)] = 1.0F;
  }
  EXPECT_EQ(Vfh{}.extract(view).skipped, "0 points have a normal, fewer than 32");
  EXPECT_EQ((Vfh{.min_points = 41}.extract(view).skipped),
            "40 pixels of the object have depth, fewer than 41");
}

/// 36 points of a square plate, which have a normal, and 40 of a line, which have none.
ObjectView plate_and_line_of_vfh() {
  ObjectView view = blank_view(40, 40);
  const auto show = [&](int row, int column) {
    view.mask[view.index(row, column)] = 1;
    view.depth_m[view.index(row, column)] = 1.0F;
  };
  for (int column = 0; column < 40; ++column) show(20, column);
  for (int i = 0; i < 36; ++i) show(30 + i / 6, 2 + i % 6);
  return view;
}

TEST(Vfh, OnlyPointsWithANormalAreCounted) {
  const ObjectView view = plate_and_line_of_vfh();
  EXPECT_EQ((Vfh{.min_points = 36}.extract(view).skipped), "");
  EXPECT_EQ((Vfh{.min_points = 37}.extract(view).skipped),
            "36 points have a normal, fewer than 37");
}

TEST(Vfh, NeedsIntrinsics) {
  ObjectView view = plate_and_line_of_vfh();
  view.focal_px = 0.0;
  EXPECT_EQ(Vfh{}.extract(view).skipped, "the camera's intrinsics are not finite numbers");
}

/// Pairs with the centroid, one a point, count 1/35 each in four blocks, lines of sight 1/36.
TEST(Vfh, SizesHaveTheirShareOfAView) {
  const Vfh with_sizes{.size_block = true, .min_points = 36};
  const FeatureResult result = with_sizes.extract(plate_and_line_of_vfh());
  ASSERT_TRUE(result.extracted()) << result.skipped;
  EXPECT_NEAR(result.vector.segment(kSizeBlock, 45).squaredNorm(), 36.0 / (4.0 * 36.0 + 35.0),
              1e-5);
  EXPECT_NEAR(result.vector.squaredNorm(), 1.0, 1e-5);
}

}  // namespace
}  // namespace vantage
