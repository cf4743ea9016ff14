// Which objects of a database hardly differ.
#include "vantage/recognition/calibration/near_duplicates.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace vantage {
namespace {

using ::testing::ElementsAre;

ObjectStates objects_of_bins(int objects, int bins) {
  ObjectStates states{.objects = {}, .categories = {"cup"}, .category_of = {}, .bins = bins};
  for (int k = 0; k < objects; ++k) {
    states.objects.push_back("cup_" + std::to_string(k));
    states.category_of.push_back(0);
  }
  return states;
}

/// One number of variance 1 of each state: Bhattacharyya distances are (difference)^2 / 8.
ObservationModel measuring(const std::vector<double>& means, double psi = 1.0) {
  ObservationModel model{.feature = "colour",
                         .mean = Eigen::MatrixXf(1, std::ssize(means)),
                         .variance = Eigen::MatrixXf::Ones(1, std::ssize(means)),
                         .psi = psi};
  for (std::size_t i = 0; i < means.size(); ++i) {
    model.mean(0, static_cast<Eigen::Index>(i)) = static_cast<float>(means[i]);
  }
  return model;
}

double differing_by(double nats) { return std::sqrt(8.0 * nats); }

std::vector<int> groups_of(const std::vector<ObservationModel>& models, int objects, int bins) {
  return near_duplicate_groups(models, objects_of_bins(objects, bins), 1);
}

// ln 50 = 3.912.
TEST(NearDuplicateGroups, HoldWhatMoreThanOneOfAHundredDecisionsConfuses) {
  EXPECT_THAT(groups_of({measuring({1.0, 1.0 + differing_by(3.8)})}, 2, 1), ElementsAre(0, 0));
  EXPECT_THAT(groups_of({measuring({1.0, 1.0 + differing_by(4.0)})}, 2, 1), ElementsAre(0, 1));
}

// ln 5 = 1.609; at half of them wrong nobody is.
TEST(NearDuplicateGroups, AreFewerTheMoreMustBeConfused) {
  const auto groups = [](double nats, double confused) {
    return near_duplicate_groups(std::vector{measuring({1.0, 1.0 + differing_by(nats)})},
                                 objects_of_bins(2, 1), 1, {}, confused);
  };
  EXPECT_THAT(groups(1.6, 0.1), ElementsAre(0, 0));
  EXPECT_THAT(groups(1.62, 0.1), ElementsAre(0, 1));
  EXPECT_THAT(groups(0.0, 0.5), ElementsAre(0, 1));
}

TEST(NearDuplicateGroups, CompareSidesThatBothAreSeenFrom) {
  const std::vector<ObservationModel> models{measuring({1.0, 5.0, 1.0 + differing_by(3.8), 5.0})};
  EXPECT_THAT(groups_of(models, 2, 2), ElementsAre(0, 0)) << "by a mean of 1.9";
  const std::vector<ObservationModel> far{measuring({1.0, 5.0, 1.0 + differing_by(4.0), 5.0})};
  EXPECT_THAT(groups_of(far, 2, 2), ElementsAre(0, 0)) << "by a mean of 2";
  EXPECT_THAT(near_duplicate_groups(far, objects_of_bins(2, 2), 1, std::vector<int>{1, 3}),
              ElementsAre(0, 1));
}

TEST(NearDuplicateGroups, AreOfAllFeaturesByTheirPsi) {
  const auto apart = [](double nats, double psi) {
    return measuring({2.0, 2.0 - differing_by(nats)}, psi);
  };
  EXPECT_THAT(groups_of({apart(7.6, 0.5)}, 2, 1), ElementsAre(0, 0));
  EXPECT_THAT(groups_of({apart(8.0, 0.5)}, 2, 1), ElementsAre(0, 1));
  EXPECT_THAT(groups_of({apart(3.0, 1.0), apart(0.8, 1.0)}, 2, 1), ElementsAre(0, 0));
  EXPECT_THAT(groups_of({apart(3.0, 1.0), apart(2.0, 0.5)}, 2, 1), ElementsAre(0, 1));
  EXPECT_THAT(groups_of({apart(50.0, 0.0), apart(1.0, 1.0)}, 2, 1), ElementsAre(0, 0));
}

TEST(NearDuplicateGroups, AreNumberedAsTheyAppear) {
  EXPECT_THAT(groups_of({measuring({0.0, 50.0, 0.5, 100.0, 50.5})}, 5, 1),
              ElementsAre(0, 1, 0, 2, 1));
}

TEST(NearDuplicateGroups, HangTogetherByThoseBetween) {
  const double step = differing_by(3.0);
  EXPECT_THAT(groups_of({measuring({0.0, step, 2.0 * step, 50.0})}, 4, 1), ElementsAre(0, 0, 0, 1));
  const std::vector<int> joined = groups_of({measuring({0.0, 2.0 * step, step, 50.0})}, 4, 1);
  EXPECT_EQ(joined[0], joined[1]);
  EXPECT_EQ(joined[0], joined[2]);
  EXPECT_NE(joined[0], joined[3]);
}

TEST(NearDuplicateGroups, CompareObjectsAtTheTurnWhereTheyAreMostAlike) {
  EXPECT_THAT(groups_of({measuring({0.0, 20.0, 40.0, 20.0, 40.0, 0.0})}, 2, 3), ElementsAre(0, 0));
  EXPECT_THAT(groups_of({measuring({0.0, 20.0, 40.0, 40.0, 20.0, 0.0})}, 2, 3), ElementsAre(0, 1))
      << "the other way round";
  // Over three bins 11.4 nats are 3.8 on average, and 12 are 4.
  for (const double nats : {11.4, 12.0}) {
    const double off = differing_by(nats);
    EXPECT_THAT(groups_of({measuring({0.0, 40.0, 80.0, 0.0, 40.0, 80.0 + off})}, 2, 3),
                ElementsAre(0, nats < 11.7 ? 0 : 1));
  }
}

TEST(NearDuplicateGroups, GoByTheSidesThatBothAreSeenFromAlone) {
  const auto groups = [](const std::vector<double>& means, const std::vector<int>& unseen) {
    return near_duplicate_groups(std::vector{measuring(means)}, objects_of_bins(2, 2), 1, unseen);
  };
  EXPECT_THAT(groups({1.0, 90.0, 1.0, 50.0}, {1, 3}), ElementsAre(0, 0)) << "one side is enough";
  EXPECT_THAT(groups({1.0, 90.0, 50.0, 1.0}, {1}), ElementsAre(0, 0)) << "turned by a bin";
  EXPECT_THAT(groups({1.0, 90.0, 50.0, 70.0}, {1}), ElementsAre(0, 1));
  EXPECT_THAT(groups({1.0, 1.0, 1.0, 1.0}, {0, 1}), ElementsAre(0, 1)) << "one was never seen";
}

}  // namespace
}  // namespace vantage
