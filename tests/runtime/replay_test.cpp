// A recorded drive of a few ticks, replayed as it was and after somebody changed it.
#include "vantage/runtime/replay.hpp"

#include <gmock/gmock.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "tests/sim/test_world.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/hash.hpp"
#include "vantage/core/log.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/runtime/log/state_log.hpp"

namespace vantage {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

constexpr std::uint64_t kDrivenTicks = 4;

/// Half speed for two ticks, then a quarter.
class Replays : public testing::Test {
 protected:
  Replays() {
    test::RoverWorld rover;
    World& world = rover.world;
    actuators_ = world.controls().size();
    state_size_ = world.state().size();
    StateLog log(folder_.path(), actuator_names(world), world.state());
    for (std::uint64_t tick = 0; tick < kDrivenTicks; ++tick) {
      world.set_controls(std::vector<double>(actuators_, tick < 2 ? 0.5 : 0.25));
      world.advance_tick();
      log.add(world.controls(), world.state());
    }
    log.commit();
    hash_ = log.hash();
    write_file(folder_ / "metrics.json", "{\"state_hash\": \"" + hash_text(hash_) + "\"}");
    write_file(folder_ / "manifest.json", R"({"assets": {"old.xml": "1", "scene.xml": "2"}})");
  }
  [[nodiscard]] ReplayResult replayed(const std::map<std::string, std::string>& assets = {}) const {
    test::RoverWorld rover;
    return replay(folder_.path(), rover.world, assets);
  }
  void replace_in(const std::string& name, const std::string& what, const std::string& by) const {
    std::string text = read_file(folder_ / name);
    std::size_t found = 0;
    for (auto at = text.find(what); at != text.npos; at = text.find(what, at + by.size())) {
      text.replace(at, what.size(), by);
      ++found;
    }
    ASSERT_GT(found, 0U) << what;
    write_file(folder_ / name, text);
  }
  support::TemporaryDirectory folder_;
  std::size_t actuators_ = 0;
  std::size_t state_size_ = 0;
  std::uint64_t hash_ = 0;
};

TEST_F(Replays, OfWhatWasRecordedAreTheSame) {
  const ReplayResult result = replayed({{"new.xml", "3"}, {"scene.xml", "2"}});
  EXPECT_EQ(result.first_difference, std::nullopt) << result.what;
  EXPECT_EQ(result.ticks, kDrivenTicks);
  EXPECT_EQ(result.state_hash, hash_);
  EXPECT_THAT(result.changed_files, ElementsAre("new.xml", "old.xml"));
  EXPECT_THAT(replayed({{"old.xml", "1"}, {"scene.xml", "4"}}).changed_files,
              ElementsAre("scene.xml"));
}

TEST_F(Replays, NameTheTickOfOtherCommands) {
  replace_in("actions.csv", "0.25", "0.75");
  const ReplayResult result = replayed();
  EXPECT_EQ(result.first_difference, 2U);
  EXPECT_EQ(result.ticks, 2U);
  EXPECT_NEAR(result.time_s, 0.05, 1e-9);
  EXPECT_EQ(result.what, "the commands in actions.csv are not the ones recorded");
}

TEST_F(Replays, NameTheRowThatIsWrittenOtherwise) {
  replace_in("actions.csv", "0.25", "0.250");
  const ReplayResult result = replayed();
  EXPECT_EQ(result.first_difference, 1U) << "its tick is not believed: that after the row before";
  EXPECT_EQ(result.what, "actions.csv was changed in this row");
}

TEST_F(Replays, NameTheRowThatComesAfterTheEnd) {
  std::string more = "9";
  for (std::size_t i = 0; i < actuators_; ++i) more += ",1";
  write_file(folder_ / "actions.csv", read_file(folder_ / "actions.csv") + more + "\n");
  const ReplayResult result = replayed();
  EXPECT_EQ(result.first_difference, 9U);
  EXPECT_EQ(result.ticks, kDrivenTicks);
  EXPECT_EQ(result.what, "actions.csv goes on after the last recorded state");
}

TEST_F(Replays, NameTheStateThatIsAnother) {
  std::string bytes = read_file(folder_ / "states.bin");
  const double other = 7.5;
  const std::size_t record = 8 * (state_size_ + actuators_);
  std::memcpy(bytes.data() + 17 + 16 + 3 * record + 8, &other, sizeof other);
  write_file(folder_ / "states.bin", bytes);
  const ReplayResult result = replayed();
  EXPECT_EQ(result.first_difference, 2U) << "the tick that leads to state 3";
  EXPECT_EQ(result.ticks, 2U);
  EXPECT_THAT(result.what, StartsWith("state[1] is "));
  EXPECT_THAT(result.what, EndsWith(", recorded 7.5"));
}

TEST_F(Replays, AreHeldAgainstTheHashOfTheMetrics) {
  for (const char* metrics : {"{\"state_hash\": \"0\"}", "{}", "nothing"}) {
    write_file(folder_ / "metrics.json", metrics);
    const ReplayResult result = replayed();
    EXPECT_EQ(result.first_difference, kDrivenTicks) << metrics;
    EXPECT_EQ(result.what, "metrics.json has another state_hash");
    EXPECT_EQ(result.state_hash, hash_);
  }
}

TEST_F(Replays, OfAnotherSceneAreRefused) {
  const test::SceneFolder scene(test::scene_mjcf(""));
  World other(scene.alone());
  EXPECT_THAT(test::message_of<InputError>([&] { replay(folder_.path(), other, {}); }),
              HasSubstr("states.bin: recorded with another scene or robot than "));
}

TEST_F(Replays, OfAFolderThatLacksFilesAreRefused) {
  const auto refusal = [&] {
    return test::message_of<InputError>([&] { static_cast<void>(replayed()); });
  };
  write_file(folder_ / "manifest.json", "[]");
  EXPECT_THAT(refusal(), EndsWith("manifest.json: not a JSON object"));
  std::filesystem::remove(folder_ / "states.bin");
  EXPECT_THAT(refusal(), HasSubstr("states.bin: cannot read"));
  write_file(folder_ / "config.yaml", "a: 1\n");
  EXPECT_THAT(refusal(), HasSubstr("states.bin: missing, as of lean runs; `vantage run "));
}

/// What was told before counts as well, so a process of its own has to do it.
TEST_F(Replays, TellHowFarTheyAre) {
  const auto replays = [&] {
    static_cast<void>(replayed());
    std::filesystem::remove_all(folder_.path());
    std::_Exit(0);
  };
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(replays(), testing::ExitedWithCode(0), "replay: 0 % \nreplay: 100 % \n");
  GTEST_FLAG_SET(death_test_style, "fast");
}

TEST_F(Replays, TellTheTimeOfTheEndWhereOnlyTheRestDiffers) {
  write_file(folder_ / "metrics.json", "{}");
  EXPECT_NEAR(replayed().time_s, 0.1, 1e-9);
  std::string more = "9";
  for (std::size_t i = 0; i < actuators_; ++i) more += ",1";
  write_file(folder_ / "actions.csv", read_file(folder_ / "actions.csv") + more + "\n");
  EXPECT_NEAR(replayed().time_s, 0.1, 1e-9);
}

TEST_F(Replays, OfAManifestWithoutFilesAreOfNewFilesAlone) {
  write_file(folder_ / "manifest.json", "{}");
  const ReplayResult result = replayed({{"a.xml", "1"}, {"b.xml", "2"}});
  EXPECT_EQ(result.first_difference, std::nullopt) << result.what;
  EXPECT_THAT(result.changed_files, ElementsAre("a.xml", "b.xml"));
}

TEST_F(Replays, MissARowThatWasTakenOut) {
  const std::string actions = read_file(folder_ / "actions.csv");
  const std::size_t last_row = actions.rfind('\n', actions.size() - 2) + 1;
  ASSERT_EQ(actions.substr(last_row, 2), "2,");
  write_file(folder_ / "actions.csv", actions.substr(0, last_row));
  const ReplayResult result = replayed();
  EXPECT_EQ(result.first_difference, 2U);
  EXPECT_EQ(result.what, "the commands in actions.csv are not the ones recorded");
}

TEST_F(Replays, OfAnotherNumberOfStatesOrActuatorsAreRefused) {
  for (const std::size_t more : {0U, 1U}) {
    const std::vector<std::string> names(actuators_ + more, "wheel");
    StateLog log(folder_.path(), names, std::vector<double>(state_size_ + 1 - more, 0.0));
    log.commit();
    EXPECT_THAT(test::message_of<InputError>([&] { static_cast<void>(replayed()); }),
                HasSubstr("states.bin: recorded with another scene or robot than "));
  }
}

TEST_F(Replays, OfARunWithoutATickAreTheSame) {
  test::RoverWorld rover;
  StateLog log(folder_.path(), actuator_names(rover.world), rover.world.state());
  log.commit();
  write_file(folder_ / "metrics.json", "{\"state_hash\": \"" + hash_text(log.hash()) + "\"}");
  const ReplayResult result = replayed();
  EXPECT_EQ(result.first_difference, std::nullopt) << result.what;
  EXPECT_EQ(result.ticks, 0U);
  EXPECT_EQ(ReplayResult{}.time_s, 0.0);
  EXPECT_EQ(ReplayResult{}.state_hash, 0U);
}

TEST_F(Replays, GoNoFurtherThanWhereTheyAreInterrupted) {
  const auto interrupted = [&] {
    set_verbosity(Verbosity::quiet);
    catch_interrupts();
    std::raise(SIGINT);
    try {
      static_cast<void>(replayed());
    } catch (const Interrupted&) {
      std::_Exit(7);
    }
    std::_Exit(1);
  };
  EXPECT_EXIT(interrupted(), testing::ExitedWithCode(7), "");
}

}  // namespace
}  // namespace vantage
