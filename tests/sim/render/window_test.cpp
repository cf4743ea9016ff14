#include "vantage/sim/render/window.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <thread>

#include "tests/sim/sensors/sensor_scene.hpp"
#include "tests/support/virtual_display.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

using support::DesktopUser;
using support::VirtualDisplay;

/// Another colour for each pixel.
RenderedImages colourful(int width_px, int height_px) {
  RenderedImages image;
  image.width_px = width_px;
  image.height_px = height_px;
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      image.rgb.push_back(static_cast<std::uint8_t>(x % 251));
      image.rgb.push_back(static_cast<std::uint8_t>(y % 241));
      image.rgb.push_back(static_cast<std::uint8_t>(x / 251 + 16 * (y / 241)));
    }
  }
  return image;
}

TEST(Window, HoldsThePicture) {
  const VirtualDisplay display;
  Window window("picture", {641, 353});
  ASSERT_EQ(window.size(), (PixelSize{641, 353}));
  const RenderedImages image = colourful(641, 353);
  EXPECT_EQ(window.show_and_read(image).rgb, image.rgb);
}

TEST(Window, StretchesASmallerPicture) {
  const VirtualDisplay display;
  Window window("stretched", {640, 480});
  const RenderedImages small = colourful(320, 240);
  const RenderedImages held = window.show_and_read(small);
  for (const auto& [x, y] :
       {std::pair<std::size_t, std::size_t>{0, 0}, {639, 0}, {0, 479}, {639, 479}, {101, 300}}) {
    const auto at = 3 * (y * 640 + x);
    const auto source = 3 * (y / 2 * 320 + x / 2);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(held.rgb[at + c], small.rgb[source + c]) << x;
  }
}

TEST(Window, BesideAnOffscreenRendererInAnotherThread) {
  const VirtualDisplay display;
  const auto scene = test::sensor_scene();
  const auto draw = [&] {
    RenderedImages images;
    make_offscreen_renderer(*scene.model, 320, 240)
        ->render(*scene.model, *scene.data, FixedCamera{scene.camera("oblique")}, {}, images);
    return images;
  };
  const RenderedImages alone = draw();
  Window window("beside", {320, 240});
  RenderedImages meanwhile;
  std::thread other([&] { meanwhile = draw(); });
  const RenderedImages image = colourful(320, 240);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(window.show_and_read(image).rgb, image.rgb);
  other.join();
  EXPECT_EQ(meanwhile.rgb, alone.rgb);
  EXPECT_EQ(window.show_and_read(meanwhile).rgb, alone.rgb);
}

std::vector<WindowEvent> events_of(Window& window) {
  std::vector<WindowEvent> all;
  for (int quiet = 0; quiet < 10;) {
    const auto events = window.wait(0.02);
    quiet = events.empty() ? quiet + 1 : 0;
    all.insert(all.end(), events.begin(), events.end());
  }
  return all;
}

TEST(Window, TellsKeysAndMouse) {
  const VirtualDisplay display;
  Window window("listening", {400, 300});
  DesktopUser user(display, "listening");
  for (const char* key : {"m", "space", "Right", "period", "Escape"}) user.press(key);
  std::string typed;
  for (const WindowEvent& event : events_of(window)) {
    if (const auto* key = std::get_if<KeyPressed>(&event)) typed += key->key;
  }
  EXPECT_EQ(typed, (std::string{'m', ' ', keys::right, '.', keys::escape}));

  user.drag(1, {100, 80}, {130, 60});
  user.turn_wheel(true);
  const auto events = events_of(window);
  ASSERT_EQ(events.size(), 3U);
  const auto* pressed = std::get_if<MousePressed>(&events[0]);
  const auto* dragged = std::get_if<MouseDragged>(&events[1]);
  const auto* wheel = std::get_if<WheelTurned>(&events[2]);
  ASSERT_TRUE(pressed != nullptr && dragged != nullptr && wheel != nullptr);
  EXPECT_EQ(pressed->at_px, Eigen::Vector2d(100, 80));
  EXPECT_EQ(dragged->button, MouseButton::left);
  EXPECT_EQ(dragged->by_px, Eigen::Vector2d(30, -20));
  EXPECT_EQ(wheel->notches, 1.0);
}

TEST(Window, TellsKeysWithoutACharacterApart) {
  const VirtualDisplay display;
  Window window("moving", {400, 300});
  DesktopUser user(display, "moving");
  for (const char* key : {"Left", "Right", "Up", "Down", "Prior", "Next", "Home", "End"}) {
    user.press(key);
  }
  std::string typed;
  for (const WindowEvent& event : events_of(window)) {
    if (const auto* key = std::get_if<KeyPressed>(&event)) typed += key->key;
  }
  EXPECT_EQ(typed, (std::string{keys::left, keys::right, keys::up, keys::down, keys::page_up,
                                keys::page_down, keys::home, keys::end}));
  const std::set<char> different(typed.begin(), typed.end());
  EXPECT_EQ(different.size(), 8U);
  EXPECT_FALSE(different.contains(KeyPressed{}.key)) << "which is none";
  EXPECT_EQ(keys::escape, '\x1b') << "as in ASCII";
}

TEST(Window, TellsItsButtonsApart) {
  const VirtualDisplay display;
  Window window("pressed", {400, 300});
  DesktopUser user(display, "pressed");
  user.drag(3, {50, 60}, {70, 90});
  user.turn_wheel(false);
  const auto events = events_of(window);
  ASSERT_EQ(events.size(), 3U);
  const auto* pressed = std::get_if<MousePressed>(&events[0]);
  const auto* dragged = std::get_if<MouseDragged>(&events[1]);
  const auto* wheel = std::get_if<WheelTurned>(&events[2]);
  ASSERT_TRUE(pressed != nullptr && dragged != nullptr && wheel != nullptr);
  EXPECT_EQ(pressed->button, MouseButton::right);
  EXPECT_EQ(pressed->at_px, Eigen::Vector2d(50, 60));
  EXPECT_EQ(dragged->button, MouseButton::right);
  EXPECT_EQ(dragged->at_px, Eigen::Vector2d(70, 90));
  EXPECT_EQ(dragged->by_px, Eigen::Vector2d(20, 30));
  EXPECT_EQ(wheel->notches, -1.0);
}

TEST(Window, ClosesWhenAsked) {
  const VirtualDisplay display;
  Window window("closing", {200, 200});
  EXPECT_FALSE(window.closed());
  DesktopUser(display, "closing").close();
  events_of(window);
  EXPECT_TRUE(window.closed());
}

TEST(Window, WithoutADisplay) {
  ::unsetenv("DISPLAY");
  EXPECT_THROW(Window("nowhere", {200, 200}), RendererError);
  ::setenv("DISPLAY", ":98765", 1);
  EXPECT_THROW(Window("nowhere", {200, 200}), RendererError);
  ::unsetenv("DISPLAY");
}

}  // namespace
}  // namespace vantage
