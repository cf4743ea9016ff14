#include "vantage/information/mixture_bounds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/information/distributions.hpp"
#include "vantage/information/discrete.hpp"

namespace vantage {
namespace {

using ::testing::HasSubstr;

constexpr double kBoundTolerance = 1e-6;  // divergences are single precision
constexpr float kFloatInfinity = std::numeric_limits<float>::infinity();

Eigen::MatrixXf all_apart(int size, float nats) {
  Eigen::MatrixXf D = Eigen::MatrixXf::Constant(size, size, nats);
  D.diagonal().setZero();
  return D;
}

Eigen::MatrixXf random_divergences(std::size_t size) {
  const auto n = static_cast<Eigen::Index>(size);
  Eigen::MatrixXf D(n, n);
  for (float& nats : D.reshaped()) nats = static_cast<float>(*rc::gen::inRange(0, 500)) / 100.0F;
  D.diagonal().setZero();
  return D;
}

std::vector<int> random_groups(std::size_t size) {
  return *rc::gen::container<std::vector<int>>(size, rc::gen::inRange(0, 3));
}

/// Entropy of the groups.
double group_entropy_bits(const std::vector<double>& b, const std::vector<int>& group) {
  std::vector<double> mass(3, 0.0);
  for (std::size_t i = 0; i < b.size(); ++i) mass[static_cast<std::size_t>(group[i])] += b[i];
  return entropy_bits(mass);
}

TEST(PairwiseInformation, OfComponentsThatAreAlikeIsNothing) {
  const double bits =
      pairwise_information_bits(std::vector{0.5, 0.25, 0.25}, Eigen::MatrixXf::Zero(3, 3));
  EXPECT_EQ(bits, 0.0);
  EXPECT_FALSE(std::signbit(bits));
}

TEST(PairwiseInformation, OfComponentsFarApartIsTheirEntropy) {
  EXPECT_EQ(pairwise_information_bits(std::vector{0.5, 0.5}, all_apart(2, kFloatInfinity)), 1.0);
  EXPECT_NEAR(pairwise_information_bits(std::vector{0.5, 0.25, 0.25}, all_apart(3, 100.0F)), 1.5,
              kBoundTolerance);
}

TEST(PairwiseInformation, IsTheFormula) {
  EXPECT_NEAR(pairwise_information_bits(std::vector{0.5, 0.5}, all_apart(2, std::log(2.0F))),
              -std::log2(0.75), kBoundTolerance);
}

TEST(PairwiseInformation, ImpossibleComponentsCountForNothing) {
  const double two = pairwise_information_bits(std::vector{0.5, 0.5}, all_apart(2, 0.7F));
  EXPECT_NEAR(pairwise_information_bits(std::vector{0.5, 0.0, 0.5}, all_apart(3, 0.7F)), two,
              kBoundTolerance);
}

TEST(PairwiseInformation, NamesWhatIsWrong) {
  const auto message = [](const std::vector<double>& b, const Eigen::MatrixXf& D) -> std::string {
    try {
      pairwise_information_bits(b, D);
    } catch (const DistributionError& error) {
      return error.what();
    }
    return "nothing thrown";
  };
  EXPECT_THAT(message({0.5, 0.4}, all_apart(2, 1.0F)), HasSubstr("0.9"));
  EXPECT_THAT(message({0.5, 0.5}, all_apart(3, 1.0F)), HasSubstr("2 components and 3 x 3"));
  EXPECT_THAT(message({0.5, 0.5}, all_apart(2, -1.0F)), HasSubstr("D(1, 0) = -1"));
  EXPECT_THAT(message({0.5, 0.5}, all_apart(2, std::nanf(""))), HasSubstr("nan"));
}

TEST(GroupInformation, NamesWhatIsWrong) {
  const std::vector b{0.5, 0.5};
  EXPECT_THROW(pairwise_group_information_bits(b, std::vector{1}, all_apart(2, 1.0F)),
               DistributionError);
  EXPECT_THROW(group_information_upper_bound_bits(b, std::vector{0, -1}, all_apart(2, 1.0F)),
               DistributionError);
}

TEST(GroupInformation, OfTwoTwinsThatDifferFromOneSide) {
  // Two objects in two poses; only their second poses differ, and poses are told apart for sure.
  const std::vector b{0.25, 0.25, 0.25, 0.25};
  const std::vector group{0, 0, 1, 1};
  Eigen::MatrixXf D = all_apart(4, kFloatInfinity);
  D(0, 2) = D(2, 0) = 0.0F;
  EXPECT_NEAR(pairwise_group_information_bits(b, group, D), 0.5, kBoundTolerance);
  EXPECT_GE(group_information_upper_bound_bits(b, group, D), 0.5 - kBoundTolerance);
}

/// Four components that nothing is symmetrical about, the first and third in one group.
struct OddMixture {
  std::vector<double> b{0.3, 0.2, 0.4, 0.1};
  std::vector<int> group{5, 2, 5, 2};
  Eigen::MatrixXf D{{0.0F, 0.7F, 1.1F, 0.4F},
                    {0.9F, 0.0F, 0.3F, 1.6F},
                    {0.2F, 1.3F, 0.0F, 0.8F},
                    {2.1F, 0.6F, 0.5F, 0.0F}};
};

TEST(PairwiseInformation, TakesDivergencesFromRowToColumn) {
  const OddMixture odd;
  EXPECT_NEAR(pairwise_information_bits(odd.b, odd.D), 0.6239123343824355, kBoundTolerance);
}

TEST(GroupInformation, IsTheFormula) {
  const OddMixture odd;
  EXPECT_NEAR(pairwise_group_information_bits(odd.b, odd.group, odd.D), 0.22863189853897517,
              kBoundTolerance);
  EXPECT_NEAR(group_information_upper_bound_bits(odd.b, odd.group, odd.D), 0.3716949848819051,
              kBoundTolerance);
}

TEST(GroupInformation, ComponentsAndGroupsWithoutMassCountForNothing) {
  const OddMixture odd;
  const std::vector<double> b{0.3, 0.0, 0.2, 0.4, 0.1, 0.0};
  const std::vector<int> group{5, 5, 2, 5, 2, 9};
  const std::vector<int> kept{0, 2, 3, 4};
  Eigen::MatrixXf D = Eigen::MatrixXf::Constant(6, 6, 0.15F);
  D(kept, kept) = odd.D;
  EXPECT_NEAR(pairwise_group_information_bits(b, group, D), 0.22863189853897517, kBoundTolerance);
  EXPECT_NEAR(group_information_upper_bound_bits(b, group, D), 0.3716949848819051, kBoundTolerance);
}

TEST(GroupInformation, TakesNoDivergencesOfAnotherShape) {
  const std::vector b{0.5, 0.5};
  const std::vector group{0, 1};
  EXPECT_THROW(pairwise_information_bits(b, Eigen::MatrixXf::Zero(2, 3)), DistributionError);
  EXPECT_THROW(pairwise_information_bits(b, Eigen::MatrixXf::Zero(3, 2)), DistributionError);
  EXPECT_THROW(pairwise_group_information_bits(b, group, Eigen::MatrixXf::Zero(2, 3)),
               DistributionError);
  EXPECT_THROW(group_information_upper_bound_bits(b, group, Eigen::MatrixXf::Zero(3, 2)),
               DistributionError);
  EXPECT_THROW(
      group_information_upper_bound_bits(b, std::vector{0, 1, 1}, Eigen::MatrixXf::Zero(2, 2)),
      DistributionError);
  EXPECT_THROW(pairwise_group_information_bits(b, std::vector{-1, 0}, Eigen::MatrixXf::Zero(2, 2)),
               DistributionError);
}

RC_GTEST_PROP(PairwiseInformationProperty, LiesBetweenNothingAndTheEntropy, ()) {
  const auto b = test::random_distribution();
  const auto D = random_divergences(b.size());
  const double bits = pairwise_information_bits(b, D);
  RC_ASSERT(bits >= 0.0);
  RC_ASSERT(bits <= entropy_bits(b) + kBoundTolerance);
  RC_ASSERT(pairwise_information_bits(b, 2.0F * D) >= bits - kBoundTolerance);
}

RC_GTEST_PROP(GroupInformationProperty, LiesBetweenNothingAndTheEntropyOfTheGroups, ()) {
  const auto b = test::random_distribution();
  const auto D = random_divergences(b.size());
  const auto group = random_groups(b.size());
  const double bits = pairwise_group_information_bits(b, group, D);
  const double upper = group_information_upper_bound_bits(b, group, D);
  RC_ASSERT(bits >= 0.0);
  RC_ASSERT(bits <= pairwise_information_bits(b, D) + kBoundTolerance);
  RC_ASSERT(upper >= 0.0);
  RC_ASSERT(upper <= group_entropy_bits(b, group) + kBoundTolerance);
}

RC_GTEST_PROP(GroupInformationProperty, OfGroupsOfOneIsThatOfComponents, ()) {
  const auto b = test::random_distribution();
  const auto D = random_divergences(b.size());
  std::vector<int> own(b.size());
  for (std::size_t i = 0; i < own.size(); ++i) own[i] = static_cast<int>(3 * (own.size() - i));
  const double bits = pairwise_information_bits(b, D);
  RC_ASSERT(std::abs(pairwise_group_information_bits(b, own, D) - bits) < kBoundTolerance);
  RC_ASSERT(std::abs(group_information_upper_bound_bits(b, own, D) - bits) < kBoundTolerance);
  const std::vector<int> one(b.size(), 7);
  RC_ASSERT(pairwise_group_information_bits(b, one, D) < kBoundTolerance);
  RC_ASSERT(group_information_upper_bound_bits(b, one, D) < kBoundTolerance);
}

}  // namespace
}  // namespace vantage
