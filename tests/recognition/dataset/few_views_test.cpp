#include "vantage/recognition/dataset/few_views.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

namespace vantage {
namespace {

/// `views` of two objects of two bins, each recognised with a lead of 2 nats.
HeldOutViews all_right(int views) {
  HeldOutViews held_out{.state = {}, .bins = 2, .log_density = {Eigen::MatrixXf(4, views)}};
  for (int v = 0; v < views; ++v) {
    const int object = v % 2;
    held_out.state.push_back(2 * object);
    held_out.log_density[0].col(v).setConstant(-2.0F);
    held_out.log_density[0](2 * object, v) = 0.0F;
  }
  return held_out;
}

double psi_of(const HeldOutViews& held_out) {
  const ObservationModel model{.feature = "colour", .mean = {}, .variance = {}};
  return choose_psi(CalibratedPsi{}, {.models = std::span(&model, 1), .held_out = held_out})[0];
}

// One mistake among n + 1 of equal lead: p = n / (n + 1), so psi * 2 nats = about ln n. The lead is
// over an object whose two bins add up.
TEST(FewViews, AMistakeKeepsPsiFinite) {
  HeldOutViews held_out = all_right(20);
  const double certain = psi_of(held_out);
  add_a_mistake(held_out);
  ASSERT_EQ(held_out.state.size(), 21U);
  const double psi = psi_of(held_out);
  EXPECT_GE(certain, 10.0);
  const double own = 1.0 + std::exp(-2.0 * psi);
  const double right = own / (own + 2.0 * std::exp(-2.0 * psi));
  EXPECT_NEAR(right, 20.0 / 21.0, 0.03);
}

TEST(FewViews, TheScoreIsThatOfTheObjectOverTheFirstViews) {
  HeldOutViews held_out = all_right(6);
  held_out.log_density[0].col(5).setConstant(-9.0F);
  const LogObject five = log_object(held_out, std::vector{1.0}, 5);
  const double own = 1.0 + std::exp(-2.0);
  EXPECT_NEAR(five.mean, std::log(own / (own + 2.0 * std::exp(-2.0))), 1e-6);
  EXPECT_NEAR(five.standard_error, 0.0, 1e-4);
  EXPECT_LT(log_object(held_out, std::vector{1.0}, 6).mean, five.mean);
}

TEST(FewViews, OfOneObjectThereIsNoMistake) {
  HeldOutViews held_out{.state = {0}, .bins = 2, .log_density = {Eigen::MatrixXf::Zero(2, 1)}};
  add_a_mistake(held_out);
  EXPECT_EQ(held_out.state.size(), 1U);
}

}  // namespace
}  // namespace vantage
