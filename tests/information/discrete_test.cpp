#include "vantage/information/discrete.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "tests/information/distributions.hpp"

namespace vantage {
namespace {

using test::flat;
using test::random_distribution;
using test::random_joint;
using ::testing::HasSubstr;
using Vector = std::vector<double>;

constexpr double kTolerance = 1e-9;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

template <class Call>
std::string message_of(Call call) {
  try {
    call();
  } catch (const DistributionError& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(Entropy, KnownAnswers) {
  EXPECT_DOUBLE_EQ(entropy_bits(Vector{0.5, 0.5}), 1.0);
  EXPECT_DOUBLE_EQ(entropy_bits(Vector{0.5, 0.25, 0.125, 0.125}), 1.75);
  EXPECT_DOUBLE_EQ(entropy_bits(Vector{1.0, 0.0, 0.0}), 0.0);
  EXPECT_DOUBLE_EQ(entropy_bits(Vector{1.0}), 0.0);
}

// The joint distribution of [CoverThomas2006], example 2.2.1 (rows y, columns x there).
TEST(JointMeasures, TextbookExample) {
  Eigen::MatrixXd p(4, 4);
  p << 1.0 / 8, 1.0 / 16, 1.0 / 16, 1.0 / 4,  //
      1.0 / 16, 1.0 / 8, 1.0 / 16, 0.0,       //
      1.0 / 32, 1.0 / 32, 1.0 / 16, 0.0,      //
      1.0 / 32, 1.0 / 32, 1.0 / 16, 0.0;
  EXPECT_NEAR(joint_entropy_bits(p), 27.0 / 8, kTolerance);
  EXPECT_NEAR(conditional_entropy_bits(p), 13.0 / 8, kTolerance);
  EXPECT_NEAR(conditional_entropy_bits(p.transpose()), 11.0 / 8, kTolerance);
  EXPECT_NEAR(mutual_information_bits(p), 3.0 / 8, kTolerance);
}

TEST(KlDivergence, KnownAnswers) {
  const Vector p{0.5, 0.5};
  const Vector q{0.75, 0.25};
  EXPECT_NEAR(kl_divergence_bits(p, q), 0.2075187496394219, kTolerance);
  EXPECT_NEAR(kl_divergence_bits(q, p), 0.1887218755408671, kTolerance);
  EXPECT_NEAR(jeffreys_divergence_bits(p, q), 0.396240625180289, kTolerance);
}

TEST(KlDivergence, IsInfiniteWhereOnlyQIsZero) {
  const Vector p{0.5, 0.5};
  const Vector q{1.0, 0.0};
  EXPECT_EQ(kl_divergence_bits(p, q), kInfinity);
  EXPECT_EQ(kl_divergence_bits(q, p), 1.0);
  EXPECT_NEAR(kl_divergence_bits(Vector{1.0, 0.0}, Vector{1e-310, 1.0}), 1029.8, 0.1)
      << "whose ratio is beyond what numbers hold";
  EXPECT_EQ(jeffreys_divergence_bits(q, p), kInfinity);
}

TEST(BinaryEntropy, KnownAnswers) {
  EXPECT_EQ(binary_entropy_bits(0.0), 0.0);
  EXPECT_EQ(binary_entropy_bits(1.0), 0.0);
  EXPECT_EQ(binary_entropy_bits(0.5), 1.0);
  EXPECT_NEAR(binary_entropy_bits(0.11), 0.499915958164528, kTolerance);
}

TEST(Validation, NamesTheOffendingValue) {
  EXPECT_THAT(message_of([] {
                entropy_bits(Vector{0.5, -0.25, 0.75});
              }),
              HasSubstr("p[1] = -0.25"));
  EXPECT_THAT(message_of([] { entropy_bits(Vector{0.5, kNan}); }), HasSubstr("p[1] = nan"));
  EXPECT_THAT(message_of([] { entropy_bits(Vector{kInfinity}); }), HasSubstr("p[0] = inf"));
  EXPECT_THAT(message_of([] { entropy_bits(Vector{0.5, 0.4}); }), HasSubstr("sums to 0.9"));
  EXPECT_THAT(message_of([] { entropy_bits(Vector{}); }), HasSubstr("empty"));
  EXPECT_THAT(message_of([] { binary_entropy_bits(1.5); }), HasSubstr("1.5"));
  EXPECT_THAT(message_of([] { binary_entropy_bits(kNan); }), HasSubstr("nan"));
}

TEST(Validation, NamesTheArgumentOfAPair) {
  const Vector good{0.5, 0.5};
  EXPECT_THAT(message_of([&] { kl_divergence_bits(good, Vector{1.0}); }),
              HasSubstr("p has 2 entries, q has 1"));
  EXPECT_THAT(message_of([&] {
                kl_divergence_bits(good, Vector{0.5, 0.75});
              }),
              HasSubstr("q sums to 1.25"));
  EXPECT_THAT(message_of([&] {
                jeffreys_divergence_bits(Vector{-1.0, 2.0}, good);
              }),
              HasSubstr("p[0] = -1"));
}

TEST(Validation, CoversJoints) {
  Eigen::MatrixXd p = Eigen::MatrixXd::Constant(2, 3, 1.0 / 6);
  p(1, 2) = -0.5;
  for (const auto measure :
       {&joint_entropy_bits, &conditional_entropy_bits, &mutual_information_bits}) {
    EXPECT_THAT(message_of([&] { measure(p); }), HasSubstr("p_xy(1, 2) = -0.5"));
    EXPECT_THAT(message_of([&] { measure(Eigen::MatrixXd(0, 3)); }), HasSubstr("empty (0 x 3)"));
    EXPECT_THAT(message_of([&] { measure(Eigen::MatrixXd::Ones(2, 1)); }), HasSubstr("sums to 2"));
  }
}

TEST(Validation, SumsMayBeOffByAMillionth) {
  for (const double off : {-0.9e-6, 0.9e-6}) {
    EXPECT_NO_THROW(entropy_bits(Vector{0.25, 0.75 + off}));
  }
  for (const double off : {-1.5e-6, 1.5e-6}) {
    EXPECT_THAT(message_of([&] {
                  entropy_bits(Vector{0.25, 0.75 + off});
                }),
                HasSubstr("entropy_bits: p sums to"));
  }
}

TEST(JointMeasures, OfRowsAndColumnsThatDiffer) {
  Eigen::MatrixXd p(2, 3);
  p << 0.05, 0.1, 0.15,  //
      0.2, 0.3, 0.2;
  EXPECT_NEAR(joint_entropy_bits(p), 2.408694969562842, kTolerance);
  EXPECT_NEAR(conditional_entropy_bits(p), 1.5274040703321494, kTolerance);
  EXPECT_NEAR(mutual_information_bits(p), 0.0314677781132109, kTolerance);
}

RC_GTEST_PROP(EntropyProperty, LiesBetweenZeroAndLog2N, ()) {
  const Vector p = random_distribution();
  RC_ASSERT(entropy_bits(p) >= 0.0);
  RC_ASSERT(entropy_bits(p) <= std::log2(static_cast<double>(p.size())) + kTolerance);
}

RC_GTEST_PROP(EntropyProperty, BinaryEntropyIsTheEntropyOfTwoOutcomes, ()) {
  const double p = *rc::gen::inRange(0, 1001) / 1000.0;
  const double expected = entropy_bits(Vector{p, 1.0 - p});
  RC_ASSERT(std::abs(binary_entropy_bits(p) - expected) < kTolerance);
  RC_ASSERT(binary_entropy_bits(p) == binary_entropy_bits_unchecked(p));
}

// H(l p + (1 - l) q) >= l H(p) + (1 - l) H(q).  [Potthast2016, (2.5)]
RC_GTEST_PROP(EntropyProperty, IsConcave, ()) {
  const Vector p = random_distribution();
  const Vector q = random_distribution(p.size());
  const double weight = *rc::gen::inRange(0, 101) / 100.0;
  Vector mixed(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) mixed[i] = weight * p[i] + (1.0 - weight) * q[i];
  RC_ASSERT(entropy_bits(mixed) + kTolerance >=
            weight * entropy_bits(p) + (1.0 - weight) * entropy_bits(q));
}

RC_GTEST_PROP(JointProperty, ChainRule, ()) {
  const Eigen::MatrixXd p = random_joint();
  const double h_x = entropy_bits(flat(p.rowwise().sum()));
  RC_ASSERT(std::abs(joint_entropy_bits(p) - h_x - conditional_entropy_bits(p)) < kTolerance);
}

RC_GTEST_PROP(JointProperty, MutualInformationIsSymmetricAndNotNegative, ()) {
  const Eigen::MatrixXd p = random_joint();
  const double information = mutual_information_bits(p);
  RC_ASSERT(information >= 0.0);
  RC_ASSERT(std::abs(information - mutual_information_bits(p.transpose())) < kTolerance);
}

RC_GTEST_PROP(JointProperty, MutualInformationIsKlOfJointAndProduct, ()) {
  const Eigen::MatrixXd p = random_joint();
  const Eigen::MatrixXd product = p.rowwise().sum() * p.colwise().sum();
  const double expected = kl_divergence_bits(flat(p), flat(product));
  RC_ASSERT(std::abs(mutual_information_bits(p) - expected) < kTolerance);
}

RC_GTEST_PROP(JointProperty, MutualInformationIsEntropyLost, ()) {
  const Eigen::MatrixXd p = random_joint();
  const double h_y = entropy_bits(flat(p.colwise().sum()));
  const double expected = h_y - conditional_entropy_bits(p);
  RC_ASSERT(std::abs(mutual_information_bits(p) - expected) < kTolerance);
}

RC_GTEST_PROP(DivergenceProperty, KlIsNotNegativeAndZeroOnEqualArguments, ()) {
  const Vector p = random_distribution();
  RC_ASSERT(kl_divergence_bits(p, random_distribution(p.size())) >= 0.0);
  RC_ASSERT(kl_divergence_bits(p, p) == 0.0);
}

RC_GTEST_PROP(DivergenceProperty, JeffreysIsTheSymmetricSum, ()) {
  const Vector p = random_distribution();
  const Vector q = random_distribution(p.size());
  const double forward = jeffreys_divergence_bits(p, q);
  const double backward = jeffreys_divergence_bits(q, p);
  const double sum = kl_divergence_bits(p, q) + kl_divergence_bits(q, p);
  RC_ASSERT(forward >= 0.0);
  RC_ASSERT(jeffreys_divergence_bits(p, p) == 0.0);
  RC_ASSERT(forward == backward || std::abs(forward - backward) < kTolerance);
  RC_ASSERT(forward == sum || std::abs(forward - sum) < kTolerance);
}

}  // namespace
}  // namespace vantage
