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

}  // namespace
}  // namespace vantage
