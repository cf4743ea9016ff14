#include "vantage/core/error.hpp"

#include <gtest/gtest.h>

namespace vantage {
namespace {

// Other programs script against these numbers.
TEST(Error, EachKindHasItsExitCode) {
  EXPECT_EQ(static_cast<int>(ConfigError("x").code()), 2);
  EXPECT_EQ(static_cast<int>(InputError("x").code()), 3);
  EXPECT_EQ(static_cast<int>(DivergedError("x").code()), 4);
  EXPECT_EQ(static_cast<int>(OutputError("x").code()), 5);
  EXPECT_EQ(static_cast<int>(RendererError("x").code()), 6);
  EXPECT_STREQ(ConfigError("what happened").what(), "what happened");
}

TEST(ErrorDeathTest, BrokenExpectationNamesWhatAndWhere) {
  expects(true, "fine");
  EXPECT_DEATH(expects(false, "a grid needs cells"), "a grid needs cells .*error_test.cpp");
}

TEST(Error, OfSeveralProblemsSaysHowManyMoreThereAre) {
  const ConfigError error(std::vector<std::string>{"first", "second", "third"});
  EXPECT_STREQ(error.what(), "first (and 2 more)");
  EXPECT_EQ(error.code(), ExitCode::usage);
  EXPECT_EQ(error.problems(), (std::vector<std::string>{"first", "second", "third"}));
  const ConfigError one(std::vector<std::string>{"alone"});
  EXPECT_STREQ(one.what(), "alone");
  EXPECT_EQ(ConfigError("plain").problems(), std::vector<std::string>{"plain"});
}

TEST(Error, ExitCodesAreThoseOfTheManual) {
  EXPECT_EQ(static_cast<int>(ExitCode::done), 0);
  EXPECT_EQ(static_cast<int>(ExitCode::goal_failed), 1);
  EXPECT_EQ(static_cast<int>(ExitCode::internal), 70);
  EXPECT_EQ(static_cast<int>(ExitCode::interrupted), 130);
  EXPECT_EQ(static_cast<int>(ExitCode::terminated), 143);
  EXPECT_EXIT(expects(false, "a way"), testing::ExitedWithCode(70), "internal error: a way");
}

}  // namespace
}  // namespace vantage
