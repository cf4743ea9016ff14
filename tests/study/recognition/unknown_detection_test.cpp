#include "vantage/study/recognition/unknown_detection.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace vantage {
namespace {

TEST(AreaUnderCurve, IsTheShareOfPairsInOrder) {
  Rng rng(1);
  std::vector<double> high;
  std::vector<double> low;
  for (int i = 0; i < 57; ++i) high.push_back(std::floor(10.0 * rng.uniform(0.2, 1.0)));
  for (int i = 0; i < 83; ++i) low.push_back(std::floor(10.0 * rng.uniform()));
  double pairs = 0.0;
  for (const double h : high) {
    for (const double l : low) pairs += h > l ? 1.0 : h == l ? 0.5 : 0.0;
  }
  EXPECT_NEAR(area_under_curve(high, low), pairs / (57.0 * 83.0), 1e-12);
  EXPECT_EQ(area_under_curve(std::vector{1.0}, std::vector{0.0}), 1.0);
  EXPECT_EQ(area_under_curve(std::vector{1.0}, std::vector{1.0}), 0.5);
}

TEST(FoundAbove, IsTheLowestOfTheShare) {
  const std::vector<double> values{0.1, 0.9, 0.5, 0.7, 0.3, 0.2, 0.8, 0.6, 0.4, 1.0};
  EXPECT_EQ(found_above(values, 0.9), 0.2);
  EXPECT_EQ(found_above(values, 1.0), 0.1);
  EXPECT_EQ(found_above({0.3}, 0.9), 0.3);
}

TEST(UnknownDetection, CountsAlarmsAndWhatIsFound) {
  std::vector<Trial> known;
  for (int i = 0; i < 20; ++i) {
    known.push_back({.object = i % 5,
                     .name = fmt::format("known_{}", i % 5),
                     .unknown_probability = i < 2 ? 0.8 : 0.01 * i});
  }
  UnknownTrials unknown;
  for (int i = 0; i < 10; ++i) {
    const bool found = i < 9;
    unknown.trials.push_back({.object = -1,
                              .name = fmt::format("unknown_{}", i % 3),
                              .correct = found,
                              .category_correct = i % 2 == 0,
                              .unknown_probability = found ? 0.7 + 0.01 * i : 0.1});
    unknown.category_known.push_back(i < 4);
  }
  const UnknownDetection detection = detection_of(known, unknown, 1);
  EXPECT_EQ(detection.threshold, 0.7);
  EXPECT_DOUBLE_EQ(detection.false_alarms, 0.1);
  EXPECT_DOUBLE_EQ(detection.found, 0.9);
  EXPECT_DOUBLE_EQ(detection.known_missed, 0.1);
  EXPECT_DOUBLE_EQ(detection.category_known_right, 0.5);
  EXPECT_DOUBLE_EQ(detection.category_unknown_right, 0.6);
  EXPECT_GE(detection.area, detection.area_interval.low);
  EXPECT_LE(detection.area, detection.area_interval.high);
}

TEST(UnknownDetection, OfWhatIsWellApartIsCertain) {
  const std::vector<Trial> known(4, Trial{.name = "known", .unknown_probability = 0.2});
  UnknownTrials unknown;
  unknown.trials.assign(3, Trial{.object = -1, .name = "unknown", .unknown_probability = 0.9});
  unknown.category_known.assign(3, true);
  const UnknownDetection detection = detection_of(known, unknown, 1);
  EXPECT_DOUBLE_EQ(detection.area, 1.0);
  EXPECT_DOUBLE_EQ(detection.area_interval.low, 1.0);
  EXPECT_DOUBLE_EQ(detection.area_interval.high, 1.0);
  EXPECT_EQ(detection.threshold, 0.9);
  EXPECT_EQ(detection.false_alarms, 0.0);
  EXPECT_EQ(detection.false_alarms_interval.high, 0.0);
  EXPECT_EQ(detection.found, 1.0);
  EXPECT_EQ(detection.known_missed, 0.0);
  EXPECT_TRUE(std::isnan(detection.category_known_right)) << "none is held for right";
  EXPECT_TRUE(std::isnan(detection.category_unknown_right));
}

/// At the threshold is an alarm; at one half nothing is held for unknown.
TEST(UnknownDetection, EndsOfItsThresholds) {
  std::vector<Trial> known;
  for (const double p : {0.5, 0.5, 0.8, 0.1}) {
    known.push_back({.name = "known", .unknown_probability = p});
  }
  UnknownTrials unknown;
  for (const double p : {0.8, 0.5}) {
    unknown.trials.push_back({.object = -1, .name = "unknown", .unknown_probability = p});
    unknown.category_known.push_back(false);
  }
  const UnknownDetection detection = detection_of(known, unknown, 1);
  EXPECT_EQ(detection.threshold, 0.5);
  EXPECT_DOUBLE_EQ(detection.false_alarms, 0.75);
  EXPECT_DOUBLE_EQ(detection.found, 0.5);
  EXPECT_DOUBLE_EQ(detection.known_missed, 0.25);
  EXPECT_DOUBLE_EQ(detection.area, (3.5 + 1.0 + 1.0) / 8.0);
}

TEST(UnknownDetection, IsOfNothingUnlessTold) {
  const UnknownDetection none{};
  for (const double share :
       {none.area, none.threshold, none.false_alarms, none.found, none.known_missed,
        none.category_known_right, none.category_unknown_right}) {
    EXPECT_EQ(share, 0.0);
  }
}

/// Of known objects and then of unknown ones as many are drawn as there are. By a seed whose last
/// draw of a thousand is one of the ends, so that it shows.
TEST(UnknownDetection, IntervalsAreOfAThousandDraws) {
  const std::size_t kObjects = 12;
  std::vector<Trial> known;
  UnknownTrials unknown;
  for (std::size_t i = 0; i < kObjects; ++i) {
    const auto x = static_cast<double>(i);
    known.push_back(
        {.name = fmt::format("known_{}", i), .unknown_probability = std::fmod(0.618034 * x, 1.0)});
    unknown.trials.push_back({.object = -1,
                              .name = fmt::format("unknown_{}", i),
                              .unknown_probability = 0.2 + 0.8 * std::fmod(0.414214 * x, 1.0)});
    unknown.category_known.push_back(true);
  }
  const auto drawn = [&](const std::vector<Trial>& trials, Rng& rng) {
    std::vector<double> values;
    for (std::size_t i = 0; i < kObjects; ++i) {
      values.push_back(trials[rng.uniform_index(kObjects)].unknown_probability);
    }
    return values;
  };
  const auto alarms_of = [](const std::vector<double>& low, std::vector<double> high) {
    std::ranges::sort(high);
    const double threshold = high[1];  // eleven of twelve are found
    return static_cast<double>(
               std::ranges::count_if(low, [&](double p) { return p >= threshold; })) /
           static_cast<double>(low.size());
  };
  const auto ends = [](std::vector<double> values, std::size_t count) {
    values.resize(count);
    std::ranges::sort(values);
    return Interval{values[25], values[values.size() - 26]};
  };
  const auto areas_and_alarms = [&](std::uint64_t seed) {
    Rng rng = Rng::stream(seed, "unknown objects");
    std::vector<double> areas, alarms;
    for (int draw = 0; draw < 1000; ++draw) {
      const std::vector<double> low = drawn(known, rng);
      const std::vector<double> high = drawn(unknown.trials, rng);
      areas.push_back(area_under_curve(high, low));
      alarms.push_back(alarms_of(low, high));
    }
    return std::pair(areas, alarms);
  };
  const auto shows_the_last = [&](std::uint64_t seed) {
    const std::vector<double> areas = areas_and_alarms(seed).first;
    const Interval all = ends(areas, 1000);
    const Interval fewer = ends(areas, 999);
    return std::max(std::abs(all.low - fewer.low), std::abs(all.high - fewer.high)) > 1e-9;
  };
  std::uint64_t seed = 1;
  while (seed < 200 && !shows_the_last(seed)) ++seed;
  ASSERT_LT(seed, 200U);
  const auto [areas, alarms] = areas_and_alarms(seed);
  const Interval area = ends(areas, 1000);
  const Interval alarm = ends(alarms, 1000);
  const UnknownDetection detection = detection_of(known, unknown, seed);
  EXPECT_DOUBLE_EQ(detection.area_interval.low, area.low);
  EXPECT_DOUBLE_EQ(detection.area_interval.high, area.high);
  EXPECT_DOUBLE_EQ(detection.false_alarms_interval.low, alarm.low);
  EXPECT_DOUBLE_EQ(detection.false_alarms_interval.high, alarm.high);
}

}  // namespace
}  // namespace vantage
