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

/// Four states of two objects, three views, two features.
HeldOutViews odd_views() {
  HeldOutViews held_out{.state = {3, 0, 2}, .bins = 2, .log_density = {}};
  held_out.log_density.emplace_back(Eigen::MatrixXf{
      {0.2F, -1.0F, 0.4F}, {1.0F, 0.6F, -0.5F}, {-0.3F, 0.9F, 1.2F}, {0.7F, -0.2F, 0.1F}});
  held_out.log_density.emplace_back(Eigen::MatrixXf{
      {0.1F, 0.5F, -0.2F}, {-0.4F, 0.3F, 0.6F}, {0.8F, -0.6F, 0.2F}, {0.0F, 0.4F, -1.0F}});
  return held_out;
}

TEST(FewViews, TheScoreIsOfAllFeaturesByTheirPsi) {
  const LogObject log = log_object(odd_views(), std::vector{0.5, 2.0}, 2);
  EXPECT_NEAR(log.mean, -0.3932574533686542, 1e-6);
  EXPECT_NEAR(log.standard_error, 0.056536522066833406, 1e-6);
  const LogObject none = log_object(odd_views(), std::vector{0.5, 2.0}, 0);
  EXPECT_EQ(none.mean, 0.0);
  EXPECT_EQ(none.standard_error, 0.0);
}

TEST(FewViews, TheScoreOfAnImpossibleObjectIsFinite) {
  HeldOutViews held_out{.state = {0}, .bins = 1, .log_density = {Eigen::MatrixXf(2, 1)}};
  held_out.log_density[0] << -500.0F, 0.0F;
  EXPECT_NEAR(log_object(held_out, std::vector{1.0}, 1).mean, std::log(1e-12), 1e-9);
}

/// Three objects of two bins. The leads of the views are 5, 1 and 3.
TEST(FewViews, TheMistakeIsTheViewOfMedianLeadForTheSecondObject) {
  HeldOutViews held_out{.state = {2, 3, 2}, .bins = 2, .log_density = {Eigen::MatrixXf(6, 3)}};
  held_out.log_density[0] << -9.0F, -9.0F, -6.0F,  //
      -8.0F, -4.0F, -7.0F,                         //
      -1.0F, -7.0F, -1.0F,                         //
      -5.0F, -3.0F, -2.0F,                         //
      -6.0F, -8.0F, -5.0F,                         //
      -7.0F, -9.0F, -4.0F;
  add_a_mistake(held_out);
  EXPECT_EQ(held_out.state, (std::vector<int>{2, 3, 2, 5}));
  ASSERT_EQ(held_out.log_density[0].cols(), 4);
  EXPECT_TRUE(held_out.log_density[0].col(3) == held_out.log_density[0].col(2));
  EXPECT_EQ(held_out.log_density[0](1, 1), -4.0F);
}

TEST(FewViews, LeadsOfAllFeaturesAddUpAndTheFirstFeatureTellsTheSecondObject) {
  HeldOutViews held_out{
      .state = {0, 0, 0}, .bins = 1, .log_density = {Eigen::MatrixXf(3, 3), Eigen::MatrixXf(3, 3)}};
  held_out.log_density[0] << 0.0F, 0.0F, 0.0F,  //
      -2.0F, -1.0F, -9.0F,                      //
      -3.0F, -6.0F, -4.0F;
  held_out.log_density[1] << 0.0F, 0.0F, 0.0F,  //
      -9.0F, -1.0F, -8.0F,                      //
      -3.0F, -7.0F, -2.0F;
  add_a_mistake(held_out);  // leads of 2 + 3, 1 + 1 and 4 + 2
  EXPECT_EQ(held_out.state.back(), 1);
  EXPECT_TRUE(held_out.log_density[0].col(3) == held_out.log_density[0].col(0));
  EXPECT_TRUE(held_out.log_density[1].col(3) == held_out.log_density[1].col(0));
}

/// Densities of many dimensions are far from 1; only their ratios count.
TEST(FewViews, TheScoreIsTheSameHoweverSmallOrLargeDensitiesAre) {
  for (const float of_all : {-5000.0F, -1000.0F, 0.0F, 1000.0F}) {
    HeldOutViews held_out{.state = {0}, .bins = 1, .log_density = {Eigen::MatrixXf(2, 1)}};
    held_out.log_density[0] << of_all, of_all - 1.0F;
    EXPECT_NEAR(log_object(held_out, std::vector{1.0}, 1).mean, -std::log(1.0 + std::exp(-1.0)),
                1e-9)
        << of_all;
  }
}

TEST(FewViews, OfNoViewThereIsNoMistakeAndOfASingleOneThereIs) {
  HeldOutViews none = all_right(0);
  add_a_mistake(none);
  EXPECT_TRUE(none.state.empty());
  EXPECT_EQ(none.log_density[0].cols(), 0);
  HeldOutViews one = all_right(1);
  add_a_mistake(one);
  EXPECT_EQ(one.state, (std::vector<int>{0, 2}));
  EXPECT_EQ(one.log_density[0].cols(), 2);
}

TEST(FewViews, TheMistakeMayBeForTheFirstStateOfAll) {
  HeldOutViews held_out{.state = {2}, .bins = 2, .log_density = {Eigen::MatrixXf(4, 1)}};
  held_out.log_density[0] << -1.0F, -3.0F, 0.0F, -2.0F;
  add_a_mistake(held_out);
  EXPECT_EQ(held_out.state, (std::vector<int>{2, 0}));
}

/// Of the first two views the first feature rules out the other object; beyond a million nats the
/// second one decides, by 3 and 5.
TEST(FewViews, ALeadOfAMillionNatsIsAsGoodAsAnyGreaterOne) {
  HeldOutViews held_out{
      .state = {0, 0, 0}, .bins = 1, .log_density = {Eigen::MatrixXf(2, 3), Eigen::MatrixXf(2, 3)}};
  held_out.log_density[0] << 0.0F, 0.0F, 0.0F,  //
      -1.9e6F, -1.2e6F, -1.0F;
  held_out.log_density[1] << 0.0F, 0.0F, 0.0F,  //
      -3.0F, -5.0F, -1.0F;
  add_a_mistake(held_out);
  EXPECT_TRUE(held_out.log_density[1].col(3) == held_out.log_density[1].col(0));
}

}  // namespace
}  // namespace vantage
