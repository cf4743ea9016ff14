#include "vantage/sim/world/mujoco_errors.hpp"

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <filesystem>
#include <thread>

#include "tests/support/mjcf.hpp"
#include "vantage/sim/stepping/near_pairs.hpp"

namespace vantage {
namespace {

/// What MuJoCo's own handlers leave behind.
class MujocoErrors : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::remove(kLog); }
  void TearDown() override { EXPECT_FALSE(std::filesystem::exists(kLog)); }
  static constexpr auto kLog = "MUJOCO_LOG.TXT";
};

TEST_F(MujocoErrors, ErrorThrowsInsteadOfEndingTheProcess) {
  install_mujoco_handlers();
  EXPECT_THROW(
      {
        try {
          mju_error("out of order\n");
        } catch (const MujocoError& error) {
          EXPECT_STREQ(error.what(), "out of order");
          throw;
        }
      },
      MujocoError);
}

TEST_F(MujocoErrors, ErrorDeepInsideACallThrows) {
  const test::MjcfModel scene = test::compile_mjcf(
      "<mujoco><worldbody><body><freejoint/><geom size='.1'/></body></worldbody></mujoco>");
  scene.data->nstack = 1;
  EXPECT_THROW(mj_forward(scene.model.get(), scene.data.get()), MujocoError);
}

TEST_F(MujocoErrors, WarningsGoToTheInnermostCollectorOfTheThread) {
  install_mujoco_handlers();
  std::vector<std::string> outer;
  std::vector<std::string> inner;
  const WarningCollector outer_collector(outer);
  mju_warning("one");
  {
    const WarningCollector inner_collector(inner);
    mju_warning("two");
    std::thread([] { mju_warning("of another thread"); }).join();
  }
  mju_warning("three");
  EXPECT_EQ(outer, (std::vector<std::string>{"one", "three"}));
  EXPECT_EQ(inner, (std::vector<std::string>{"two"}));
}

TEST_F(MujocoErrors, PairsThatAreFarApartAreLeftOut) {
  install_mujoco_handlers();
  EXPECT_EQ(mjcb_contactfilter, &discard_far_pair);
}

}  // namespace
}  // namespace vantage
