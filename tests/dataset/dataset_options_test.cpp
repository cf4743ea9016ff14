// Limits of what a dataset is rendered with, and what its processes tell each other.
#include "vantage/dataset/dataset_options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "vantage/core/error.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/dataset/render_worker.hpp"

namespace vantage {
namespace {

/// Of one key at both of its ends and beyond them.
template <class T>
void expect_limits(T DatasetOptions::*key, T least, T most, T below, T above) {
  const auto with = [&](T value) {
    DatasetOptions options;
    options.*key = value;
    check_options(options);
  };
  EXPECT_NO_THROW(with(least)) << least;
  EXPECT_NO_THROW(with(most)) << most;
  EXPECT_THROW(with(below), ConfigError) << below;
  EXPECT_THROW(with(above), ConfigError) << above;
}

TEST(DatasetLimits, OfNumbers) {
  expect_limits(&DatasetOptions::objects, 1, 100000, 0, 100001);
  expect_limits(&DatasetOptions::mask_growth_px, 0, 20, -1, 21);
  expect_limits(&DatasetOptions::margin_px, 0, 50, -1, 51);
  expect_limits(&DatasetOptions::supersampling, 1, 7, -1, 9);
  expect_limits(&DatasetOptions::step_deg, 0.1, 360.0, 0.09, 360.1);
  expect_limits(&DatasetOptions::distance_m, 0.3, 3.0, 0.29, 3.01);
  expect_limits(&DatasetOptions::placement_m, 0.0, 0.1, -0.001, 0.101);
  expect_limits(&DatasetOptions::lighting, 0.0, 2.0, -0.01, 2.01);
  expect_limits(&DatasetOptions::colour_noise, 0.0, 100.0, -0.1, 100.1);
  expect_limits(&DatasetOptions::edge_dropout, 0.0, 1.0, -0.01, 1.01);
  DatasetOptions options;
  options.session = 0;
  EXPECT_THROW(check_options(options), ConfigError);
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
