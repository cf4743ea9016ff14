#include "vantage/runtime/log/state_log.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

const std::array<std::string, 1> kNames{"wheel"};

/// A replay must command what was commanded to the bit, or its hash is another.
TEST(StateLog, RecordsEachCommandThatIsNotTheSameToTheBit) {
  const support::TemporaryDirectory folder;
  const std::array<double, 2> state{0.0, 1.0};
  StateLog log(folder.path(), kNames, state);
  for (const double command : {0.0, -0.0, -0.0, 0.5}) log.add(std::array{command}, state);
  log.commit();
  const auto actions = read_actions(folder / "actions.csv", kNames);
  ASSERT_EQ(actions.size(), 3U);
  EXPECT_FALSE(std::signbit(actions[0].controls.front()));
  EXPECT_EQ(actions[1].tick, 1U);
  EXPECT_TRUE(std::signbit(actions[1].controls.front()));
  EXPECT_EQ(actions[2].tick, 3U);
  for (const RecordedAction& action : actions) EXPECT_TRUE(action.canonical);
}

TEST(StateLog, NamesTheStateThatHoldsNoNumber) {
  const support::TemporaryDirectory folder;
  StateLog log(folder.path(), kNames, std::array{0.0, 1.0});
  log.add(std::array{0.5}, std::array{1.0, std::nan("")});
  log.commit();
  const RecordedStates states = read_states(folder / "states.bin");
  EXPECT_EQ(states.finite_state(0)[1], 1.0);
  try {
    static_cast<void>(states.finite_state(1));
    ADD_FAILURE() << "it is not finite";
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(),
              (folder / "states.bin").string() + ": state 1 holds a number that is not finite");
  }
}

}  // namespace
}  // namespace vantage
