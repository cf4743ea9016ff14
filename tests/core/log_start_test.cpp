// What a process says that has just begun.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>

#include "vantage/core/log.hpp"

namespace vantage {
namespace {

using testing::HasSubstr;

/// In a process of its own, which nothing was told to or shown in.
void expect_said(const std::function<void()>& says,
                 const testing::Matcher<const std::string&>& expected) {
  const auto ends = [&] {
    says();
    std::_Exit(0);
  };
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(ends(), testing::ExitedWithCode(0), expected);
  GTEST_FLAG_SET(death_test_style, "fast");
}

void make_progress(double total, double done) { Progress("work", total).update(done); }

TEST(LogStartDeathTest, SaysNoDetailsUnlessAsked) {
  const auto says = [] {
    log_debug("hidden");
    log_info("shown");
  };
  expect_said(says, testing::AllOf(HasSubstr("info: shown\n"), testing::Not(HasSubstr("hidden")),
                                   testing::Not(HasSubstr("\r"))));
}

TEST(LogStartDeathTest, ProgressIsAShareOfTheWhole) {
  expect_said([] { make_progress(0.5, 0.25); }, HasSubstr("work: 50 % \n"));
}

TEST(LogStartDeathTest, ProgressOfNothingIsAtItsEnd) {
  expect_said([] { make_progress(0.0, 0.0); }, HasSubstr("work: 100 % \n"));
}

TEST(LogStartDeathTest, ProgressIsNoMoreThanTheWhole) {
  expect_said([] { make_progress(4.0, 9.0); }, HasSubstr("work: 100 % \n"));
}

TEST(LogStartDeathTest, ProgressIsNoLessThanNothing) {
  expect_said([] { make_progress(4.0, -1.0); }, HasSubstr("work: 0 % \n"));
}

}  // namespace
}  // namespace vantage
