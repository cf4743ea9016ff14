#include "vantage/geometry/gaze.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "vantage/core/rng.hpp"

namespace vantage {
namespace {

constexpr double kQuarter_rad = std::numbers::pi / 2.0;

/// Two rows of four images, squares of 90 degrees if not told otherwise.
SweepImages eight(double tan_half_width = 1.0, double tan_half_height = 1.0) {
  std::vector<Gaze> gazes;
  for (const double tilt_rad : {0.0, 0.8}) {
    for (int i = 0; i < 4; ++i) gazes.push_back({(i - 1) * kQuarter_rad, tilt_rad});
  }
  return {std::move(gazes), tan_half_width, tan_half_height};
}

/// A point of the sweep's frame turned into that of an image: x ahead, y left, z up.
Eigen::Vector3d in_image(const Gaze& gaze, const Eigen::Vector3d& p_sweep) {
  const double c = std::cos(-gaze.pan_rad);
  const double s = std::sin(-gaze.pan_rad);
  const Eigen::Vector3d panned(c * p_sweep.x() - s * p_sweep.y(), s * p_sweep.x() + c * p_sweep.y(),
                               p_sweep.z());
  const double ct = std::cos(gaze.tilt_rad);
  const double st = std::sin(gaze.tilt_rad);
  return {ct * panned.x() - st * panned.z(), panned.y(), st * panned.x() + ct * panned.z()};
}

TEST(Gaze, LooksAheadLeftAndDown) {
  EXPECT_LT((direction_of({0.0, 0.0}) - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((direction_of({kQuarter_rad, 0.0}) - Eigen::Vector3d::UnitY()).norm(), 1e-12);
  EXPECT_LT((direction_of({0.3, kQuarter_rad}) + Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(SweepImages, ShowWhatIsInsideTheirEdges) {
  const SweepImages images = eight(0.7, 0.4);
  Rng rng(5);
  int shown = 0;
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector3d p(rng.uniform(-3.0, 3.0), rng.uniform(-3.0, 3.0), rng.uniform(-3.0, 3.0));
    for (std::size_t image = 0; image < images.gazes().size(); ++image) {
      const Eigen::Vector3d q = in_image(images.gazes()[image], p);
      const bool inside =
          q.x() > 0.0 && std::abs(q.y()) <= 0.7 * q.x() && std::abs(q.z()) <= 0.4 * q.x();
      EXPECT_EQ(images.shows(image, p), inside) << p.transpose() << " in " << image;
      shown += inside ? 1 : 0;
    }
  }
  EXPECT_GT(shown, 1000);
}

TEST(SweepImages, OneOfSeveralIsEnough) {
  const SweepImages images = eight();
  const Eigen::Vector3d left(0.1, 2.0, 0.0);
  EXPECT_FALSE(images.any_shows(std::array<std::size_t, 2>{0, 3}, left));
  EXPECT_TRUE(images.any_shows(std::array<std::size_t, 2>{0, 2}, left));
  EXPECT_FALSE(images.any_shows({}, left));
}

TEST(SweepImages, TheNearestIsTheOneThatLooksMostDirectly) {
  const SweepImages images = eight();
  EXPECT_EQ(images.nearest({2.0, 0.1, 0.0}), 1U);
  EXPECT_EQ(images.nearest({0.1, -2.0, 0.1}), 0U);
  EXPECT_EQ(images.nearest({-2.0, 0.1, -0.5}), 3U) << "0.24 rad below the horizon";
  EXPECT_EQ(images.nearest({-2.0, 0.1, -1.0}), 7U) << "0.46 rad below the horizon";
  EXPECT_EQ(images.nearest({0.0, 0.0, 1.0}), 0U) << "of equals the first";
}

TEST(SweepImages, ShowTheirEdgesButNothingAtTheCamera) {
  const SweepImages images = eight();
  EXPECT_TRUE(images.shows(1, {2.0, 2.0, 0.0}));
  EXPECT_TRUE(images.shows(1, {2.0, -2.0, 0.0}));
  EXPECT_TRUE(images.shows(1, {2.0, 0.0, 2.0}));
  EXPECT_TRUE(images.shows(1, {2.0, 0.0, -2.0}));
  EXPECT_FALSE(images.shows(1, {2.0, 2.001, 0.0}));
  EXPECT_FALSE(images.shows(1, {2.0, 0.0, 2.001}));
  EXPECT_FALSE(images.shows(1, {0.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace vantage
