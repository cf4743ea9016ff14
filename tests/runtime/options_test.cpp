// Defaults and ranges of what every episode has, by number.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/option_numbers.hpp"
#include "vantage/runtime/episode_setup.hpp"

namespace vantage {
namespace {

using support::expect_numbers;

TEST(RuntimeOptions, OfRobotsAndRecordings) {
  expect_numbers(RobotOptions{}, {{"start_view", 0, at_least(0)},
                                  {"start_behind_m", 0.0, between(0.0, 100.0)},
                                  {"start_pose", support::kNull}});
  expect_numbers(RecordingOptions{}, {{"video_speed", 10.0, between(1.0, 1000.0)},
                                      {"video_fps", 25, between(1, 120)},
                                      {"height_px", 720, between(120, 2160)}});
}

TEST(RuntimeOptions, OfEpisodes) {
  EpisodeOptions options;
  EXPECT_EQ(options.seed, 1U);
  EXPECT_EQ(options.threads, 2);
  EXPECT_NO_THROW(check_options(options));
  for (const int threads : {1, 256}) {
    options.threads = threads;
    EXPECT_NO_THROW(check_options(options)) << threads;
  }
  for (const int threads : {0, 257}) {
    options.threads = threads;
    EXPECT_THROW(check_options(options), ConfigError) << threads;
  }
}

TEST(RuntimeOptions, ARobotStartsWhereItIsPosed) {
  RobotOptions robot;
  EXPECT_EQ(robot.posed_start().x_m, 0.0);
  EXPECT_EQ(robot.posed_start().y_m, 0.0);
  EXPECT_EQ(robot.posed_start().yaw_rad, 0.0);
  robot.start_pose = {1.5, -2.5, 4.0};
  EXPECT_EQ(robot.posed_start().x_m, 1.5);
  EXPECT_EQ(robot.posed_start().y_m, -2.5);
  EXPECT_NEAR(robot.posed_start().yaw_rad, 4.0 - 2.0 * std::numbers::pi, 1e-12);
}

}  // namespace
}  // namespace vantage
