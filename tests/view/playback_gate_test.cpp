#include "vantage/view/playback_gate.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace vantage {
namespace {

using namespace std::chrono_literals;

/// Passes the gate until it closes, and counts.
class Walker {
 public:
  explicit Walker(PlaybackGate& gate) : gate_(gate) {
    thread_ = std::thread([this] {
      while (gate_.wait(0.025)) {
        ++passes_;
        passes_.notify_all();
      }
    });
  }
  Walker(const Walker&) = delete;
  Walker& operator=(const Walker&) = delete;
  ~Walker() { finish(); }

  int finish() {
    gate_.close();
    if (thread_.joinable()) thread_.join();
    return passes_;
  }
  void wait_for_pass(int number) const {
    for (int seen = passes_; seen < number; seen = passes_) passes_.wait(seen);
  }

 private:
  PlaybackGate& gate_;
  std::atomic<int> passes_ = 0;
  std::thread thread_;
};

TEST(PlaybackGate, OpenItLetsEverythingPass) {
  PlaybackGate gate;
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(gate.wait(0.025));
}

TEST(PlaybackGate, PausedItLetsExactlyTheStepsPass) {
  PlaybackGate gate;
  gate.pause();
  Walker walker(gate);
  for (int i = 1; i <= 3; ++i) {
    gate.step();
    walker.wait_for_pass(i);
  }
  EXPECT_TRUE(gate.paused());
  EXPECT_EQ(walker.finish(), 3);
}

TEST(PlaybackGate, AStepPauses) {
  PlaybackGate gate;
  Walker walker(gate);
  walker.wait_for_pass(10);
  gate.step();
  EXPECT_TRUE(gate.paused());
}

TEST(PlaybackGate, ResumedItGoesOn) {
  PlaybackGate gate;
  gate.toggle_pause();
  EXPECT_TRUE(gate.paused());
  Walker walker(gate);
  gate.toggle_pause();
  EXPECT_FALSE(gate.paused());
  walker.wait_for_pass(100);
}

TEST(PlaybackGate, ClosedItLetsNothingPass) {
  PlaybackGate gate;
  gate.close();
  gate.step();
  EXPECT_FALSE(gate.wait(0.025));
}

TEST(PlaybackGate, ASeekEndsAPausesWait) {
  PlaybackGate gate;
  gate.pause();
  gate.seek(3.5);
  ASSERT_TRUE(gate.wait(0.025));
  EXPECT_EQ(gate.take_seek(), 3.5);
  EXPECT_FALSE(gate.take_seek());
  gate.seek(1.0);
  gate.seek(2.0);
  EXPECT_EQ(gate.take_seek(), 2.0) << "the last one counts";
}

TEST(PlaybackGate, WakesWhoeverWaitsInASlowOne) {
  PlaybackGate gate(1e-6);  // a tick lasts hours
  Walker walker(gate);
  gate.step();
  walker.wait_for_pass(1);
  gate.toggle_pause();
  gate.set_speed(1e6);
  walker.wait_for_pass(2);
}

TEST(NextDue, KeepsThePace) {
  const WallTime now{100s};
  EXPECT_EQ(next_due(now, now, 0.025, 1.0), now + 25ms);
  EXPECT_EQ(next_due(now, now, 0.025, 0.5), now + 50ms);
  EXPECT_EQ(next_due(now - 10ms, now, 0.025, 2.5), now);
  EXPECT_EQ(next_due(now, now, 0.025, std::numeric_limits<double>::infinity()), now);
}

TEST(NextDue, MakesUpForLittle) {
  const WallTime now{100s};
  EXPECT_EQ(next_due(now - 50ms, now, 0.025, 1.0), now - 25ms);
  EXPECT_GT(next_due(now - 10s, now, 0.025, 1.0), now - 1s);
}

TEST(PlaybackGate, ResumedItForgetsTheStepsThatWereLeft) {
  PlaybackGate gate;
  gate.step();
  gate.step();
  EXPECT_TRUE(gate.wait(0.025));
  gate.toggle_pause();  // goes on
  gate.toggle_pause();  // pauses
  EXPECT_TRUE(gate.paused());
  gate.seek(1.0);
  EXPECT_TRUE(gate.wait(0.025)) << "for the seek";
  EXPECT_EQ(gate.take_seek(), 1.0);
  gate.step();
  Walker walker(gate);
  walker.wait_for_pass(1);
  EXPECT_EQ(walker.finish(), 1);
}

TEST(NextDue, IsATenthOfASecondBehindAtMost) {
  const WallTime now{100s};
  EXPECT_EQ(next_due(now - 10s, now, 0.025, 1.0), now - 100ms);
  EXPECT_EQ(next_due(now - 120ms, now, 0.025, 1.0), now - 95ms);
}

/// However late a tick goes on, none goes on before it is due.
TEST(PlaybackGate, TicksAreDueOneAfterTheOther) {
  const WallTime begun = std::chrono::steady_clock::now();
  PlaybackGate gate(1.0);
  for (int tick = 0; tick < 5; ++tick) ASSERT_TRUE(gate.wait(0.005));
  EXPECT_GE(std::chrono::steady_clock::now(), begun + 25ms - 1us);
}

}  // namespace
}  // namespace vantage
