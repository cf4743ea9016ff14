// Long work: each item once, with progress, until somebody throws.
#include "vantage/recognition/dataset/long_work.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/terminal.hpp"
#include "vantage/core/log.hpp"

namespace vantage {
namespace {

TEST(LongWorkDone, IsEachItemOnce) {
  for (const int threads : {1, 3}) {
    std::vector<std::atomic<int>> times(20);
    std::atomic<int> polled = 0;
    const LongWork how{.threads = threads, .poll = [&] { ++polled; }};
    work_through(times.size(), how, "work", [&](std::size_t i) { ++times[i]; });
    for (const auto& of_item : times) EXPECT_EQ(of_item, 1);
    EXPECT_EQ(polled, 20);
  }
}

TEST(LongWorkDone, IsToldOneAfterTheOtherInPlaceOfABar) {
  std::vector<std::size_t> told;
  const LongWork how{.threads = 3,
                     .tell = [&](const std::string& part, std::size_t done, std::size_t of) {
                       EXPECT_EQ(part, "sorting");
                       EXPECT_EQ(of, 5U);
                       told.push_back(done);
                     }};
  testing::internal::CaptureStderr();
  work_through(5, how, "sorting", [](std::size_t) {});
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(told, (std::vector<std::size_t>{1, 2, 3, 4, 5}));
}

TEST(LongWorkThatThrows, EndsAndSaysWhy) {
  int called = 0;
  try {
    work_through(10, {}, "work", [&](std::size_t) {
      if (++called == 3) throw std::runtime_error("the third");
    });
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "the third");
  }
  EXPECT_EQ(called, 3);
}

TEST(LongWorkThatThrows, EndsBeforeTheItemThatWasPolledFor) {
  struct Stop {};
  int polled = 0;
  int called = 0;
  const LongWork how{.poll = [&] {
    if (++polled == 4) throw Stop{};
  }};
  EXPECT_THROW(work_through(10, how, "work", [&](std::size_t) { ++called; }), Stop);
  EXPECT_EQ(polled, 4);
  EXPECT_EQ(called, 3);
}

TEST(LongWorkDone, IsShownByABar) {
  if (!support::has_terminals()) GTEST_SKIP() << "no terminal";
  const std::string shown =
      support::shown_progress([] { work_through(2, {}, "sorting", [](std::size_t) {}); });
  set_verbosity(Verbosity::normal);
  EXPECT_THAT(shown, testing::HasSubstr("sorting ["));
  EXPECT_THAT(shown, testing::AnyOf(testing::HasSubstr(" 50 %"), testing::HasSubstr("100 %")));
}

}  // namespace
}  // namespace vantage
