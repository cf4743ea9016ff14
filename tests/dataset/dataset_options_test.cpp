// Limits of what a dataset is rendered with, and what its processes tell each other.
#include "vantage/dataset/dataset_options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string_view>
#include <type_traits>
#include <vector>

#include "tests/support/option_numbers.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/dataset/render_dataset.hpp"
#include "vantage/dataset/render_worker.hpp"

namespace vantage {
namespace {

/// Each of its videos by itself.
struct OwnDatasetOptions : DatasetOptions {
  void fields(auto&& f) {
    DatasetOptions::fields(
        [&](std::string_view key, auto& value, std::string_view text, const Range& range = {}) {
          if constexpr (std::is_same_v<decltype(value), std::vector<int>&>) {
            for (int& one : value) f(key, one, text, range);
          } else {
            f(key, value, text, range);
          }
        });
  }
};

TEST(DatasetNumbers, AreThoseThatSeedsWereRenderedWith) {
  support::expect_numbers(OwnDatasetOptions{}, {{"seed", 1.0},
                                                {"session", 1.0, at_least(1)},
                                                {"objects", 326.0, between(1, 100'000)},
                                                {"step_deg", 20.0, between(0.1, 360.0)},
                                                {"videos", 1.0, between(1, 4)},
                                                {"videos", 2.0, between(1, 4)},
                                                {"videos", 4.0, between(1, 4)},
                                                {"distance_m", 0.85, between(0.3, 3.0)},
                                                {"placement_m", 0.01, between(0.0, 0.1)},
                                                {"lighting", 0.3, between(0.0, 2.0)},
                                                {"colour_noise", 4.0, between(0.0, 100.0)},
                                                {"depth_noise", 1.0},
                                                {"edge_dropout", 0.3, between(0.0, 1.0)},
                                                {"cut_by_depth", 0.0},
                                                {"mask_growth_px", 1.0, between(0, 20)},
                                                {"margin_px", 3.0, between(0, 50)},
                                                {"supersampling", 3.0, between(1, 7)}});
  DatasetOptions options;
  EXPECT_NO_THROW(check_options(options));
  options.session = 0;
  EXPECT_THROW(check_options(options), ConfigError);
  EXPECT_EQ(DatasetRun{}.jobs, 1);
  EXPECT_FALSE(DatasetRun{}.overwrite);
}

TEST(DatasetLimits, OfVideosAndRays) {
  const auto problem_of = [](const DatasetOptions& options) {
    try {
      check_options(options);
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(problem_of({.videos = {4}}), "");
  EXPECT_THAT(problem_of({.videos = {1, 3}}), testing::HasSubstr("3 is none of 1, 2, 4"));
  EXPECT_THAT(problem_of({.videos = {}}), testing::HasSubstr("some are needed, each once"));
  EXPECT_THAT(problem_of({.videos = {2, 1, 2}}), testing::HasSubstr("some are needed, each once"));
  EXPECT_EQ(problem_of({.supersampling = 5}), "");
  EXPECT_THAT(problem_of({.supersampling = 4}), testing::HasSubstr("odd"));
}

TEST(DatasetLimits, AStepBeyondHalfATurnIsOneView) {
  EXPECT_EQ(DatasetOptions{.step_deg = 360.0}.frames(), 1);
  EXPECT_EQ(DatasetOptions{.step_deg = 181.0}.frames(), 1);
  EXPECT_EQ(DatasetOptions{.step_deg = 180.0}.frames(), 2);
}

TEST(RenderMessages, AreTakenWholeOneByOne) {
  const std::string first = to_message(RenderAnswerMessage{ExitCode::output, 7, "no disk"});
  const std::string second = to_message(RenderAnswerMessage{ExitCode::done, 9, ""});
  std::string received = first.substr(0, first.size() - 1);
  EXPECT_FALSE(take_message(received));
  EXPECT_EQ(received.size(), first.size() - 1) << "it is left for the rest of it";
  received = first + second + second.substr(0, 3);
  const auto message = take_message(received);
  ASSERT_TRUE(message);
  const RenderAnswerMessage answer = parse_answer(*message);
  EXPECT_EQ(answer.code, ExitCode::output);
  EXPECT_EQ(answer.views, 7);
  EXPECT_EQ(answer.error, "no disk");
  const auto next = take_message(received);
  ASSERT_TRUE(next);
  EXPECT_EQ(parse_answer(*next).views, 9);
  EXPECT_FALSE(take_message(received));
  EXPECT_EQ(received, second.substr(0, 3));
  EXPECT_THROW((void)parse_answer(*message + "x"), InputError);
  EXPECT_THROW((void)parse_answer(message->substr(1)), InputError);
}

}  // namespace
}  // namespace vantage
