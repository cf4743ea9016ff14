#include "vantage/runtime/log/state_log.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/temporary_directory.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/hash.hpp"

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

const std::array<std::string, 2> kTwoNames{"left", "right"};

TEST(StateLog, IsReadAsItWasWritten) {
  const support::TemporaryDirectory folder;
  const std::array<double, 3> start{0.0, 1.0, 2.0};
  const std::array<double, 3> then{0.1, 3.0, -4.0};
  const std::array<double, 2> controls{0.5, -0.25};
  StateLog log(folder.path(), kTwoNames, start);
  StateLog hashed({}, kTwoNames, start);
  EXPECT_EQ(log.hash(), hash_doubles(start));
  EXPECT_EQ(log.ticks(), 0U);
  log.add(controls, then);
  hashed.add(controls, then);
  hashed.commit();
  EXPECT_EQ(log.hash(), hash_doubles(then, hash_doubles(controls, hash_doubles(start))));
  EXPECT_EQ(hashed.hash(), log.hash()) << "kept or not";
  EXPECT_EQ(log.ticks(), 1U);
  log.commit();
  const RecordedStates states = read_states(folder / "states.bin");
  EXPECT_EQ(states.state_size, 3U);
  EXPECT_EQ(states.actuators, 2U);
  EXPECT_EQ(states.record_size(), 5U);
  ASSERT_EQ(states.count(), 2U);
  EXPECT_EQ(states.values,
            (std::vector<double>{0.0, 1.0, 2.0, 0.0, 0.0, 0.1, 3.0, -4.0, 0.5, -0.25}));
  EXPECT_TRUE(std::ranges::equal(states.state(1), then));
  EXPECT_TRUE(std::ranges::equal(states.controls(1), controls));
  EXPECT_EQ(read_file(folder / "actions.csv"), "tick,left,right\n0,0.5,-0.25\n");
}

TEST(StateLog, IsRefusedWhereItIsNotWhole) {
  const support::TemporaryDirectory folder;
  const auto path = folder / "states.bin";
  {
    StateLog log(folder.path(), kNames, std::array{0.0, 1.0});
    log.add(std::array{0.5}, std::array{1.0, 2.0});
    log.commit();
  }
  const std::string good = read_file(path);
  ASSERT_EQ(good.size(), 17U + 16U + 2U * 24U);
  EXPECT_EQ(read_states(path).count(), 2U);
  for (const std::size_t size :
       {std::size_t{5}, std::size_t{20}, std::size_t{33}, good.size() - 8, good.size() - 1}) {
    write_file(path, good.substr(0, size));
    EXPECT_THROW(read_states(path), InputError) << size;
  }
  write_file(path, good.substr(0, good.size() - 8));
  try {
    static_cast<void>(read_states(path));
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(),
              path.string() + ": cut short: 40 bytes are not whole records of 3 numbers");
  }
  std::string bad = good;
  bad[0] = 'v';
  write_file(path, bad);
  EXPECT_THROW(read_states(path), InputError) << "not ours";
  bad = good;
  bad[17] = 0;
  bad[25] = 3;
  write_file(path, bad);
  EXPECT_THROW(read_states(path), InputError) << "states of no number";
}

TEST(StateLog, ActionsThatNoRecorderWritesAreNotCanonical) {
  const support::TemporaryDirectory folder;
  const auto path = folder / "actions.csv";
  write_file(path, "tick,left,right\n0,1,2\n3,0.50,1\nx,1,2\n7,1,2,3\n9,1\n12,1,-2.5\n");
  const auto actions = read_actions(path, kTwoNames);
  ASSERT_EQ(actions.size(), 6U);
  EXPECT_TRUE(actions[0].canonical);
  EXPECT_EQ(actions[0].controls, (std::vector<double>{1.0, 2.0}));
  for (const std::size_t i : {1U, 2U, 3U, 4U}) EXPECT_FALSE(actions[i].canonical) << i;
  for (const std::size_t i : {1U, 2U, 3U, 4U}) EXPECT_EQ(actions[i].tick, i) << "the one after it";
  EXPECT_TRUE(actions[5].canonical);
  EXPECT_EQ(actions[5].tick, 12U);
  EXPECT_EQ(actions[5].controls, (std::vector<double>{1.0, -2.5}));
}

TEST(StateLog, ActionsOfOtherActuatorsAreNotCanonicalOrRefused) {
  const support::TemporaryDirectory folder;
  const auto path = folder / "actions.csv";
  write_file(path, "tick,left,wrong\n0,1,2\n");
  const auto actions = read_actions(path, kTwoNames);
  ASSERT_EQ(actions.size(), 2U);
  EXPECT_FALSE(actions[0].canonical);
  EXPECT_EQ(actions[0].tick, 0U);
  EXPECT_TRUE(actions[1].canonical);
  for (const char* text :
       {"tick,left\n0,1\n", "tick,left,right,third\n", "", "tick,left,right\r\n0,1,2\r\n"}) {
    write_file(path, text);
    EXPECT_THROW(read_actions(path, kTwoNames), InputError) << text;
  }
}

TEST(StateLog, MayBeOfOneNumberAndNoActuator) {
  const support::TemporaryDirectory folder;
  StateLog log(folder.path(), {}, std::array{2.5});
  log.commit();
  const RecordedStates states = read_states(folder / "states.bin");
  EXPECT_EQ(states.state_size, 1U);
  EXPECT_EQ(states.actuators, 0U);
  EXPECT_EQ(states.values, std::vector<double>{2.5});
}

TEST(StateLog, HasNoSizesThatNoFileHolds) {
  const support::TemporaryDirectory folder;
  const auto path = folder / "states.bin";
  {
    StateLog log(folder.path(), kNames, std::array{0.0, 1.0});
    log.add(std::array{0.5}, std::array{1.0, 2.0});
    log.commit();
  }
  const std::string good = read_file(path);
  for (const std::size_t high_byte : {17U + 7U, 17U + 15U}) {
    std::string bad = good;
    bad[high_byte] = '\x20';  // 2^61 numbers are 2^64 bytes
    write_file(path, bad);
    EXPECT_THROW(read_states(path), InputError) << high_byte;
  }
}

TEST(StateLog, ActionsBeginAtTheFirstTick) {
  const support::TemporaryDirectory folder;
  write_file(folder / "actions.csv", "tick,left,right\nx,1,2\n");
  const auto actions = read_actions(folder / "actions.csv", kTwoNames);
  ASSERT_EQ(actions.size(), 1U);
  EXPECT_EQ(actions[0].tick, 0U);
  EXPECT_EQ(RecordedAction{}.tick, 0U);
  EXPECT_TRUE(RecordedAction{}.canonical);
  EXPECT_EQ(RecordedStates{}.record_size(), 0U);
}

}  // namespace
}  // namespace vantage
