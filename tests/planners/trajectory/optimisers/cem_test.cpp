#include "vantage/planners/trajectory/optimisers/cem.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/planners/trajectory/straight_flight.hpp"
#include "vantage/planners/trajectory/optimisers/smoothness.hpp"

namespace vantage {
namespace {

class CemRounds : public ::testing::Test {
 protected:
  PathCost cost() {
    return [this](const Horizon& horizon, Eigen::Ref<Eigen::VectorXd> of_point) {
      tried_.emplace_back(horizon.points.middleCols(1, horizon.free_points()));
      for (Eigen::Index i = 0; i < horizon.count(); ++i) {
        of_point[i] += 2.0 * std::abs(horizon.points(1, i) - 0.3);
      }
    };
  }
  /// The paths of a round, cheapest first.
  std::vector<Eigen::Matrix4Xd> sorted(std::vector<Eigen::Matrix4Xd> paths) {
    std::ranges::sort(paths, {}, [&](const Eigen::Matrix4Xd& path) {
      Horizon horizon = horizon_;
      horizon.points.middleCols(1, n_) = path;
      Eigen::VectorXd of_point = Eigen::VectorXd::Zero(horizon.count());
      add_control_cost(horizon, of_point);
      for (Eigen::Index i = 0; i < horizon.count(); ++i) {
        of_point[i] += 2.0 * std::abs(horizon.points(1, i) - 0.3);
      }
      return of_point.sum();
    });
    return paths;
  }
  void run(const Cem& cem) {
    Rng rng(3);
    cem(horizon_, cost(), rng);
  }

  Horizon horizon_ = test::straight_flight(7);
  Eigen::Index n_ = horizon_.free_points();
  std::vector<Eigen::Matrix4Xd> tried_;
};

/// The last path that is tried is the mean.
TEST_F(CemRounds, TheMeanGoesPartOfTheWayToTheElite) {
  const Cem cem{.rollouts = 8, .iterations = 1, .elites = 3, .learning = 0.4};
  run(cem);
  ASSERT_EQ(tried_.size(), 9U);
  const auto best = sorted({tried_.begin(), tried_.end() - 1});
  const Eigen::Matrix4Xd nominal = horizon_.points.middleCols(1, n_);
  const Eigen::Matrix4Xd elite = (best[0] + best[1] + best[2]) / 3.0;
  const Eigen::Matrix4Xd expected = nominal + 0.4 * (elite - nominal);
  EXPECT_LT((tried_.back() - expected).norm(), 1e-12);
  EXPECT_GT((expected - nominal).norm(), 0.01);
}

/// The same draws, the second round narrowed by how the elite of the first are spread.
TEST_F(CemRounds, TheNoiseGoesPartOfTheWayToTheSpreadOfTheElite) {
  const Cem cem{.rollouts = 8, .iterations = 2, .elites = 3, .learning = 0.4, .min_sigma = 0.01};
  run(cem);
  ASSERT_EQ(tried_.size(), 1U + 7U + 8U + 1U);
  const auto best = sorted({tried_.begin(), tried_.begin() + 8});
  const Eigen::Matrix4Xd nominal = horizon_.points.middleCols(1, n_);
  const Eigen::Matrix4Xd elite = (best[0] + best[1] + best[2]) / 3.0;
  Eigen::Matrix4Xd spread = Eigen::Matrix4Xd::Zero(4, n_);
  for (int e = 0; e < 3; ++e) spread.array() += (best[e] - elite).array().square() / 3.0;
  const Smoothness smoothness(n_);
  const Eigen::Matrix4Xd given =
      cem.noise.sigma() * smoothness.covariance().diagonal().cwiseSqrt().transpose();
  Rng rng(3);
  Eigen::Matrix4Xd eps(4, n_);
  for (int u = 1; u < 8; ++u) smoothness.draw(cem.noise.sigma(), rng, eps);
  smoothness.draw(cem.noise.sigma(), rng, eps);  // of the second path of the second round
  const Eigen::Matrix4Xd mean = nominal + 0.4 * (elite - nominal);
  EXPECT_EQ(tried_[8], mean) << "the first path of a round is the mean";
  for (Eigen::Index k = 0; k < eps.size(); ++k) {
    const double fitted = given(k) > 0.0 ? std::sqrt(spread(k)) / given(k) : cem.min_sigma;
    const double scale = std::max(cem.min_sigma, 1.0 + 0.4 * (fitted - 1.0));
    EXPECT_NEAR(tried_[9](k), mean(k) + scale * eps(k), 1e-12) << k;
  }
}

}  // namespace
}  // namespace vantage
