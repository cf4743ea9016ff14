// What player, painter and window hand each other, from one thread.
#include "vantage/view/link.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <thread>

namespace vantage {
namespace {

EpisodeEvent event_at(std::size_t tick) {
  EpisodeEvent event;
  event.tick = tick;
  return event;
}

TEST(ViewLink, WorkHoldsTheMomentAndWhatIsNew) {
  ViewLink link;
  link.tell(event_at(3));
  link.tell(event_at(5));
  EXPECT_EQ(link.events(), 2U);
  link.show({1.5, 2.5}, 1, true);
  auto work = link.wait_for_work();
  ASSERT_TRUE(work);
  EXPECT_EQ(work->moment.state, (std::vector<double>{1.5, 2.5}));
  EXPECT_EQ(work->moment.events, 1U);
  EXPECT_TRUE(work->moment.still);
  ASSERT_EQ(work->new_events.size(), 2U);
  EXPECT_EQ(work->new_events[1].tick, 5U);
  link.tell(event_at(8));
  link.show({3.5}, 3, false);
  work = link.wait_for_work();
  ASSERT_TRUE(work);
  EXPECT_EQ(work->moment.state, (std::vector<double>{3.5}));
  EXPECT_FALSE(work->moment.still);
  ASSERT_EQ(work->new_events.size(), 1U);
  EXPECT_EQ(work->new_events[0].tick, 8U);
}

TEST(ViewLink, OtherControlsAreWorkForTheSameMoment) {
  ViewLink link;
  link.show({1.5}, 0, false);
  ASSERT_TRUE(link.wait_for_work());
  ViewControls controls;
  controls.map = true;
  link.set_controls(controls);
  const auto work = link.wait_for_work();
  ASSERT_TRUE(work);
  EXPECT_TRUE(work->controls.map);
  EXPECT_EQ(work->moment.state, (std::vector<double>{1.5}));
}

TEST(ViewLink, AFrameIsTakenOnce) {
  ViewLink link;
  EXPECT_FALSE(link.take_frame());
  link.deliver({{}, 1.25, false});
  link.deliver({{}, 2.25, true});
  const auto frame = link.take_frame();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->time_s, 2.25) << "the last one";
  EXPECT_TRUE(frame->still);
  EXPECT_FALSE(link.take_frame());
}

TEST(ViewLink, ClosedThereIsNoWork) {
  ViewLink link;
  link.show({1.5}, 0, false);
  link.close();
  EXPECT_FALSE(link.wait_for_work());
}

TEST(ViewLink, TheFirstFailureIsThrownOnce) {
  ViewLink link;
  EXPECT_NO_THROW(link.rethrow());
  link.fail(std::make_exception_ptr(std::runtime_error("first")));
  link.fail(std::make_exception_ptr(std::logic_error("second")));
  EXPECT_THROW(link.rethrow(), std::runtime_error);
  EXPECT_NO_THROW(link.rethrow());
}

TEST(ViewLink, WhatWasDrawnIsNoWorkUntilSomethingChanges) {
  ViewLink link;
  link.show({1.5}, 0, false);
  ASSERT_TRUE(link.wait_for_work());
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    ViewControls controls;
    controls.help = true;
    link.set_controls(controls);
  });
  const auto work = link.wait_for_work();
  later.join();
  ASSERT_TRUE(work);
  EXPECT_TRUE(work->controls.help) << "it has waited for them";
}

TEST(ViewLink, ControlsAloneAreNoWork) {
  ViewLink link;
  ViewControls controls;
  controls.help = true;
  link.set_controls(controls);
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    link.show({1.5}, 0, false);
  });
  const auto work = link.wait_for_work();
  later.join();
  ASSERT_TRUE(work);
  EXPECT_EQ(work->moment.state, (std::vector<double>{1.5})) << "it has waited for a moment";
  EXPECT_TRUE(work->controls.help);
}

/// As a painter does that has nothing to draw.
TEST(ViewLink, WhoWaitsIsToldOfTheEnd) {
  ViewLink link;
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    link.close();
  });
  EXPECT_FALSE(link.wait_for_work());
  later.join();
}

}  // namespace
}  // namespace vantage
