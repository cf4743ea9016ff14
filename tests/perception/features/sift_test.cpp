#include "vantage/perception/features/sift.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>

#include "tests/support/object_views.hpp"

namespace vantage {
namespace {

const Sift kSmallSift{.words = 20, .samples_per_word = 20, .iterations = 5};

TEST(DenseSift, DescriptorsAreOfUnitLengthOnAGrid) {
  Rng rng(1);
  const ObjectView view = ball_view(100, {.radius_m = 0.07}, rng);
  const DenseSift sift = dense_root_sift(view, kSmallSift);
  ASSERT_EQ(sift.descriptors.rows(), 128);
  EXPECT_NEAR(static_cast<double>(sift.descriptors.cols()), 75.0, 15.0);  // pi (38 / 8)^2
  for (Eigen::Index i = 0; i < sift.descriptors.cols(); ++i) {
    EXPECT_NEAR(sift.descriptors.col(i).norm(), 1.0, 1e-4);
  }
  EXPECT_GE(sift.places.minCoeff(), 0.0F);
  EXPECT_LE(sift.places.maxCoeff(), 1.0F);
}

TEST(DenseSift, CropsAreBroughtToASizeBetweenTheLimits) {
  Rng rng(1);
  Sift same = kSmallSift;
  same.min_side_px = same.max_side_px = 100;
  const auto count = [&](int side_px) {
    const BallLook look{.radius_m = 0.0007 * side_px};
    return dense_root_sift(ball_view(side_px, look, rng), same).descriptors.cols();
  };
  EXPECT_NEAR(static_cast<double>(count(50)), static_cast<double>(count(200)), 12.0);
}

TEST(Sift, TheWholeCountsAsMuchAsItsQuarters) {
  Rng rng(1);
  const auto views = ball_views(6, 60, rng);
  const TrainedSift sift = kSmallSift.train(views, rng);
  ASSERT_EQ(sift.dimension(), 100);
  const FeatureResult result = sift.extract(views[0]);
  ASSERT_TRUE(result.extracted());
  const Eigen::ArrayXf shares = result.vector.array().square();
  EXPECT_NEAR(shares.sum(), 1.0, 1e-4);
  for (Eigen::Index word = 0; word < 20; ++word) {
    const float quarters =
        shares[20 + word] + shares[40 + word] + shares[60 + word] + shares[80 + word];
    EXPECT_NEAR(shares[word], quarters, 1e-4);
  }
  const Eigen::Matrix2Xf places = dense_root_sift(views[0], kSmallSift).places;
  std::array<int, 4> in_quarter{};
  for (const auto& place : places.colwise()) {
    ++in_quarter[(place.x() < 0.5F ? 0U : 1U) + (place.y() < 0.5F ? 0U : 2U)];
  }
  for (Eigen::Index q = 0; q < 4; ++q) {
    const double share = 0.5 * in_quarter[static_cast<std::size_t>(q)] / places.cols();
    EXPECT_NEAR(shares.segment(20 * (1 + q), 20).sum(), share, 1e-4) << q;
  }
}

TEST(Sift, CannotLearnFromNothing) {
  Rng rng(1);
  const std::vector<ObjectView> views{blank_view(50, 50), blank_view(0, 0)};
  EXPECT_THROW((void)kSmallSift.train(views, rng), InputError);
  EXPECT_THROW((void)kSmallSift.train({}, rng), InputError);
}

/// To 64 x 32 px: a point every 8 px.
TEST(DenseSift, OfACropThatIsNoSquareTheLongerSideIsBroughtToTheLimit) {
  Sift same = kSmallSift;
  same.min_side_px = same.max_side_px = 64;
  for (const auto& [width_px, height_px] : {std::pair{128, 64}, {64, 128}}) {
    ObjectView view = blank_view(width_px, height_px);
    std::ranges::fill(view.mask, 1);
    EXPECT_EQ(dense_root_sift(view, same).descriptors.cols(), 8 * 4) << width_px;
  }
}

TEST(Sift, ComesBackWithAsManyWordsAsItMayHave) {
  const auto why_not = [](Eigen::Index words) -> std::string {
    std::string bytes;
    put_options(bytes, Sift{.words = 2});
    put_matrix(bytes, Eigen::MatrixXf::Ones(128, words));
    ByteReader reader(bytes, "x");
    try {
      (void)Sift::take_state(reader);
      reader.finish();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(why_not(1), "");
  EXPECT_EQ(why_not(2), "");
  EXPECT_EQ(why_not(0), "x: holds too few or many words");
  EXPECT_EQ(why_not(3), "x: holds too few or many words");
}

/// Every 8 px from 4 px on, of 64 x 32 px.
TEST(DenseSift, TheGridBeginsHalfAStepFromTheBorder) {
  Sift same = kSmallSift;
  same.min_side_px = same.max_side_px = 64;
  ObjectView view = blank_view(64, 32);
  std::ranges::fill(view.mask, 1);
  const Eigen::Matrix2Xf places = dense_root_sift(view, same).places;
  ASSERT_EQ(places.cols(), 32);
  EXPECT_FLOAT_EQ(places.row(0).minCoeff(), 4.0F / 64.0F);
  EXPECT_FLOAT_EQ(places.row(0).maxCoeff(), 60.0F / 64.0F);
  EXPECT_FLOAT_EQ(places.row(1).minCoeff(), 4.0F / 32.0F);
  EXPECT_FLOAT_EQ(places.row(1).maxCoeff(), 28.0F / 32.0F);
}

/// Of an upright edge gradients are level: of eight directions only the first and the fifth occur.
TEST(DenseSift, DescriptorsAreUpright) {
  Sift same = kSmallSift;
  same.min_side_px = same.max_side_px = 64;
  ObjectView view = blank_view(64, 64);
  std::ranges::fill(view.mask, 1);
  for (int row = 0; row < 64; ++row) {
    for (int column = 30; column < 64; ++column) {
      std::fill_n(view.rgb.begin() + static_cast<std::ptrdiff_t>(3 * view.index(row, column)), 3,
                  static_cast<std::uint8_t>(200));
    }
  }
  const Eigen::MatrixXf descriptors = dense_root_sift(view, same).descriptors;
  float level = 0.0F;
  float other = 0.0F;
  for (Eigen::Index bin = 0; bin < 128; ++bin) {
    (bin % 4 == 0 ? level : other) += descriptors.row(bin).sum();
  }
  EXPECT_GT(level, 1.0F);
  EXPECT_LT(other, 1e-3F * level);
}

}  // namespace
}  // namespace vantage
