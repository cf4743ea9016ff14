// Means and paired differences with answers known beforehand.
#include "vantage/study/tables/comparison.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

#include "vantage/information/resampling.hpp"
#include "vantage/study/tables/text_table.hpp"

namespace vantage {
namespace {

const ComparisonRow& row(const Comparison& comparison, const std::string& panel,
                         const std::string& level) {
  const auto found = std::ranges::find_if(comparison.rows, [&](const ComparisonRow& r) {
    return r.panel == panel && r.level == level;
  });
  EXPECT_NE(found, comparison.rows.end()) << panel << " " << level;
  return *found;
}

/// Two panels of five pairs: "ours" is the reference less 2 in the first, half of it in the second.
Comparison two_panels() {
  std::vector<Sample> samples;
  for (std::size_t pair = 0; pair < 10; ++pair) {
    const std::size_t panel = pair / 5;
    const double theirs = 10.0 + 3.0 * static_cast<double>(pair % 5);
    samples.push_back({panel, 0, pair, theirs});
    samples.push_back({panel, 1, pair, panel == 0 ? theirs - 2.0 : 0.5 * theirs});
  }
  return compare_levels("cost", "cost, m", {"left", "right"}, {"theirs", "ours"}, 0, samples);
}

/// Four scenes of ten starts; ours is better by 1, 2, 3 and 4 in all starts of a scene: forty pairs
/// that say as much as four.
TEST(Comparison, StartsOfASceneAreAlike) {
  std::vector<Sample> samples;
  for (std::size_t pair = 0; pair < 40; ++pair) {
    const std::size_t scene = pair / 10;
    samples.push_back({0, 0, pair, 10.0, scene});
    samples.push_back({0, 1, pair, 10.0 - static_cast<double>(scene + 1), scene});
  }
  const Comparison comparison = compare_levels("cost", "cost", {"all"}, {"a", "b"}, 0, samples);
  const Difference& d = *row(comparison, "all", "b").difference;
  EXPECT_EQ(d.pairs, 40U);
  EXPECT_EQ(d.clusters, 4U);
  EXPECT_DOUBLE_EQ(d.mean, -2.5);
  EXPECT_DOUBLE_EQ(d.p_value, 2.0 / 16.0);  // the least that four scenes can give
  EXPECT_LT(d.interval.low, -3.4);
  EXPECT_GT(d.interval.high, -1.6);
}

/// Of one level and one pair: draws of a method that chooses at random.
TEST(Comparison, DrawsOfOnePairCountAsTheirMean) {
  const std::vector<Sample> samples{{0, 0, 0, 4.0}, {0, 0, 1, 6.0}, {0, 1, 0, 7.0},
                                    {0, 1, 0, 9.0}, {0, 1, 1, 6.0}, {0, 1, 1, 8.0}};
  const Comparison comparison = compare_levels("cost", "cost", {"all"}, {"a", "r"}, 0, samples);
  EXPECT_EQ(row(comparison, "all", "r").count, 2U);
  EXPECT_DOUBLE_EQ(row(comparison, "all", "r").mean, 7.5);
  EXPECT_DOUBLE_EQ(row(comparison, "all", "r").difference->mean, 2.5);
}

TEST(Comparison, OfOneSceneThereIsNoInterval) {
  const std::vector<Sample> samples{{0, 0, 0, 4.0, 7}, {0, 0, 1, 6.0, 7}};
  const Comparison comparison = compare_levels("cost", "cost", {"all"}, {"a"}, 0, samples);
  EXPECT_TRUE(comparison_json(comparison)["all"]["a"]["interval"].is_null());
}

TEST(Comparison, PairsCancelWhatTheyShare) {
  const Comparison comparison = two_panels();
  const ComparisonRow& left = row(comparison, "left", "ours");
  EXPECT_EQ(left.count, 5U);
  EXPECT_DOUBLE_EQ(left.mean, 14.0);
  EXPECT_LT(left.interval.low, 14.0);
  EXPECT_DOUBLE_EQ(left.least, 8.0);
  EXPECT_DOUBLE_EQ(left.most, 20.0);
  ASSERT_TRUE(left.difference);
  EXPECT_DOUBLE_EQ(left.difference->mean, -2.0);
  EXPECT_DOUBLE_EQ(left.difference->interval.low, -2.0);
  EXPECT_DOUBLE_EQ(left.difference->interval.high, -2.0);
  EXPECT_DOUBLE_EQ(left.difference->p_value, 2.0 / 32.0);
  const ComparisonRow& right = row(comparison, "right", "ours");
  EXPECT_DOUBLE_EQ(*right.difference->ratio, 0.5);
  EXPECT_DOUBLE_EQ(right.difference->ratio_interval->low, 0.5);
  EXPECT_DOUBLE_EQ(right.difference->ratio_interval->high, 0.5);
}

TEST(Comparison, OneEpisodeHasNoInterval) {
  const std::vector<Sample> samples{{0, 0, 0, 1.0}, {0, 1, 0, 2.0}};
  const Comparison one = compare_levels("n", "n", {"p"}, {"a", "b"}, 0, samples);
  EXPECT_EQ(comparison_csv(one).substr(comparison_csv(one).find('\n')),
            "\np,a,1,1,,,,,,,,,,\np,b,1,2,,,1,1,,,2,,,1\n");
  const auto json = comparison_json(one);
  EXPECT_TRUE(json["p"]["b"]["interval"].is_null());
  EXPECT_TRUE(json["p"]["b"]["difference"]["interval"].is_null());
  EXPECT_EQ(text_tables(one).front().rows[1],
            (std::vector<std::string>{"b", "1", "2", "1", "2", "1"}));
  EXPECT_TRUE(comparison_json(two_panels())["left"]["ours"]["interval"].is_array());
}

TEST(Comparison, InWords) {
  Comparison cost = two_panels();
  const auto line = [](const Comparison& of) { return verdicts({of}).front(); };
  ASSERT_EQ(verdicts({cost}).size(), 1U);
  EXPECT_TRUE(line(cost).starts_with("ours against theirs: cost -5 [")) << line(cost);
  EXPECT_TRUE(line(cost).ends_with("], less (10 pairs)")) << line(cost);
  cost.better = Better::lower;
  EXPECT_TRUE(line(cost).ends_with("], better (10 pairs)")) << line(cost);
  cost.better = Better::higher;
  EXPECT_TRUE(line(cost).ends_with("], worse (10 pairs)")) << line(cost);
  const std::vector<Sample> one{{0, 0, 0, 1.0}, {0, 1, 0, 2.0}};
  EXPECT_EQ(line(compare_levels("n", "n", {"p"}, {"a", "b"}, 0, one)),
            "b against a: n +1, no interval (1 pair)");
  const std::vector<Sample> both{{0, 0, 0, 1.0}, {0, 1, 0, 2.0}, {0, 0, 1, 2.0}, {0, 1, 1, 1.0}};
  EXPECT_EQ(line(compare_levels("n", "n", {"p"}, {"a", "b"}, 0, both)),
            "b against a: n 0 [-1, 1], no clear difference (2 pairs)");
}

TEST(Comparison, AllPanelsComeLast) {
  const Comparison comparison = two_panels();
  EXPECT_EQ(comparison.rows.back().panel, "all");
  EXPECT_EQ(row(comparison, "all", "ours").difference->pairs, 10U);
  EXPECT_FALSE(row(comparison, "all", "theirs").difference);
}

TEST(Comparison, UnpairedSamplesCountInTheMeanOnly) {
  const std::vector<Sample> samples{{0, 0, 0, 1.0}, {0, 1, 0, 2.0}, {0, 1, 1, 8.0}};
  const Comparison comparison = compare_levels("n", "n", {"p"}, {"a", "b"}, 0, samples);
  const ComparisonRow& b = row(comparison, "p", "b");
  EXPECT_EQ(b.count, 2U);
  EXPECT_DOUBLE_EQ(b.mean, 5.0);
  EXPECT_EQ(b.difference->pairs, 1U);
  EXPECT_DOUBLE_EQ(b.difference->mean, 1.0);
  const std::vector<Sample> first_alone{{0, 0, 1, 1.0}, {0, 1, 0, 8.0}, {0, 1, 1, 2.0}};
  const Comparison other = compare_levels("n", "n", {"p"}, {"a", "b"}, 0, first_alone);
  ASSERT_TRUE(row(other, "p", "b").difference);
  EXPECT_EQ(row(other, "p", "b").difference->pairs, 1U);
  EXPECT_DOUBLE_EQ(row(other, "p", "b").difference->mean, 1.0);
}

TEST(Comparison, WithoutReferenceThereIsNoDifference) {
  const Comparison comparison = compare_levels("n", "n", {"p"}, {"a", "b"}, 0, {{0, 1, 0, 2.0}});
  ASSERT_EQ(comparison.rows.size(), 1U);
  EXPECT_FALSE(comparison.rows[0].difference);
  EXPECT_EQ(comparison_csv(comparison),
            "panel,level,episodes,mean,low,high,pairs,difference,difference_low,difference_high,"
            "ratio,ratio_low,ratio_high,p_value\np,b,1,2,,,,,,,,,,\n");
}

TEST(Comparison, NoRatioToZero) {
  const std::vector<Sample> samples{{0, 0, 0, 0.0}, {0, 1, 0, 2.0}};
  const Comparison comparison = compare_levels("n", "n", {"p"}, {"a", "b"}, 0, samples);
  EXPECT_FALSE(row(comparison, "p", "b").difference->ratio);
  EXPECT_EQ(comparison_json(comparison)["p"]["b"]["difference"].contains("ratio"), false);
}

TEST(Comparison, OtherLevelsChangeNothing) {
  std::vector<Sample> samples{{0, 0, 0, 1.0}, {0, 0, 1, 4.0}, {0, 1, 0, 2.0}, {0, 1, 1, 9.0}};
  const auto few = compare_levels("n", "n", {"p"}, {"a", "b", "c"}, 0, samples);
  samples.push_back({0, 2, 0, 5.0});
  const auto more = compare_levels("n", "n", {"p"}, {"a", "b", "c"}, 0, samples);
  EXPECT_EQ(row(few, "p", "b").interval.low, row(more, "p", "b").interval.low);
  EXPECT_EQ(row(few, "p", "b").interval.high, row(more, "p", "b").interval.high);
}

/// The same samples give the same interval to the last digit, at any time: that of the seed 1.
TEST(Comparison, ChanceIsThatOfTheFirstSeedByTheNameOfTheRow) {
  std::vector<Sample> samples;
  std::vector<double> theirs;
  std::vector<double> ours;
  std::vector<double> differences;
  std::vector<std::size_t> marks;
  for (std::size_t pair = 0; pair < 20; ++pair) {
    theirs.push_back(10.0 + std::cos(static_cast<double>(pair)));
    ours.push_back(9.5 + 3.0 * std::sin(static_cast<double>(pair)));
    differences.push_back(ours[pair] - theirs[pair]);
    marks.push_back(pair);
    samples.push_back({0, 0, pair, theirs[pair]});
    samples.push_back({0, 1, pair, ours[pair]});
  }
  const Clusters each = clusters_of(marks);
  const auto expect_same = [](const Interval& found, const Interval& expected) {
    EXPECT_EQ(found.low, expected.low);
    EXPECT_EQ(found.high, expected.high);
  };
  const auto chance = [](const char* of) {
    return Rng::stream(1, std::string("cost/p/ours") + of);
  };
  const Comparison comparison = compare_levels("cost", "n", {"p"}, {"a", "ours"}, 0, samples);
  Rng of_mean = chance("");
  expect_same(row(comparison, "p", "ours").interval, bootstrap_mean(ours, each, of_mean));
  const Difference& d = *row(comparison, "p", "ours").difference;
  Rng of_difference = chance("/difference");
  expect_same(d.interval, bootstrap_mean(differences, each, of_difference));
  Rng of_ratio = chance("/ratio");
  expect_same(*d.ratio_interval, bootstrap_ratio(ours, theirs, each, of_ratio));
  Rng of_test = chance("/test");
  EXPECT_EQ(d.p_value, sign_flip_p_value(cluster_sums(differences, each), of_test));
}

TEST(Comparison, RowsAndDifferencesAreOfNothingUnlessTold) {
  const ComparisonRow none{};
  EXPECT_EQ(none.count, 0U);
  EXPECT_EQ(none.clusters, 0U);
  EXPECT_EQ(none.mean, 0.0);
  EXPECT_EQ(none.least, 0.0);
  EXPECT_EQ(none.most, 0.0);
  const Sample sample{};
  EXPECT_EQ(sample.panel, 0U);
  EXPECT_EQ(sample.level, 0U);
  EXPECT_EQ(sample.pair, 0U);
  EXPECT_EQ(sample.value, 0.0);
  const Difference difference{};
  EXPECT_EQ(difference.pairs, 0U);
  EXPECT_EQ(difference.clusters, 0U);
  EXPECT_EQ(difference.mean, 0.0);
  EXPECT_EQ(difference.p_value, 1.0) << "nothing speaks for one";
}

}  // namespace
}  // namespace vantage
