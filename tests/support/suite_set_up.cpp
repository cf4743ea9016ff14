// A suite that cannot be set up ends its program. GoogleTest goes on to report its tests as
// skipped, which CTest takes for what GTEST_SKIP() says, and passes.
//
// RapidCheck draws by a seed that a failure names: RC_PARAMS=seed=N repeats it.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

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
  void OnTestProgramEnd(const testing::UnitTest& tests) override {
    if (tests.test_to_run_count() > 0 && tests.skipped_test_count() == tests.test_to_run_count()) {
      std::puts("every test was skipped");  // what CTest looks for: see cmake/suites.cmake
    }
    if (tests.Passed()) return;
    std::printf("RC_PARAMS=%s repeats what RapidCheck drew\n", std::getenv("RC_PARAMS"));
  }

  bool in_test_ = false;
};

/// RapidCheck would draw a seed for itself, and tell nobody.
void seed_properties() {
  const std::string seed = "seed=" + std::to_string(std::random_device()());
  ::setenv("RC_PARAMS", seed.c_str(), 0);
}

const bool kListens = [] {
  seed_properties();
  testing::UnitTest::GetInstance()->listeners().Append(new SuiteSetUp);
  return true;
}();

}  // namespace
}  // namespace vantage
