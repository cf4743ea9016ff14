// A suite that cannot be set up ends its program. GoogleTest goes on to report its tests as
// skipped, which CTest takes for what GTEST_SKIP() says, and passes.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

namespace vantage {
namespace {

class SuiteSetUp : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo&) override { in_test_ = true; }
  void OnTestEnd(const testing::TestInfo&) override { in_test_ = false; }
  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (!result.failed() || in_test_) return;
    std::puts("[  FAILED  ] outside of a test");
    std::fflush(nullptr);
    std::_Exit(1);
  }

  bool in_test_ = false;
};

const bool kListens = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new SuiteSetUp);
  return true;
}();

}  // namespace
}  // namespace vantage
