// `vantage view` on a display in memory: what its window holds, and how it ends.
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <future>
#include <set>

#include "tests/cli/command_line.hpp"
#include "tests/support/virtual_display.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/runtime/log/event_log.hpp"
#include "vantage/tasks/episode.hpp"

namespace vantage {
namespace {

using support::DesktopUser;
using support::VirtualDisplay;

constexpr const char* kTwoScans =
    "--set scans=2 --set laser.scan_duration_s=2 --set 'map.cells=[33,33,17]' ";
constexpr const char* kSmall = "--size 400x300 ";

class View : public CommandLine {
 protected:
  /// The image that `arguments` make.
  cv::Mat shot(const std::string& name, const std::string& arguments) {
    const Result result = vantage("view " + arguments + " --screenshot " + name);
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_THAT(result.output, testing::EndsWith(name + "\n")) << "what is written is told";
    return cv::imread((folder_ / name).string(), cv::IMREAD_COLOR);
  }
  static bool same(const cv::Mat& a, const cv::Mat& b) {
    return !a.empty() && a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0.0;
  }
  static std::size_t colours(const cv::Mat& image) {
    std::set<std::array<std::uint8_t, 3>> found;
    for (const auto& pixel : cv::Mat_<cv::Vec3b>(image))
      found.insert({pixel[0], pixel[1], pixel[2]});
    return found.size();
  }
};

TEST_F(View, ARunAndItsRecordingLookTheSame) {
  const VirtualDisplay display;
  const std::string live = std::string(kTwoScans) + kSmall;
  const auto end = shot("live.png", live + "--map --gains --out run");
  ASSERT_EQ(end.size(), cv::Size(400, 300));
  EXPECT_GT(colours(end), 300U);
  EXPECT_TRUE(same(end, shot("end.png", std::string("run --map --gains ") + kSmall)));
  EXPECT_EQ(vantage("replay run").exit_code, 0);

  // In the middle, of an episode that is ended there; it leaves nothing behind.
  const std::string there = std::string("--map --gains --at 17 ") + kSmall;
  const auto half = shot("half.png", std::string(kTwoScans) + there);
  EXPECT_TRUE(same(half, shot("again.png", "run " + there)));
  EXPECT_FALSE(same(half, end));
  EXPECT_FALSE(fs::exists(folder_ / "out"));

  const auto plain = shot("plain.png", std::string("run ") + kSmall);
  const auto map = shot("map.png", std::string("run --map ") + kSmall);
  const auto gains = shot("gains.png", std::string("run --gains ") + kSmall);
  const auto start = shot("start.png", std::string("run --at 0 --map --gains ") + kSmall);
  const auto bare = shot("bare.png", std::string("run --at 0 ") + kSmall);
  EXPECT_FALSE(same(plain, map));
  EXPECT_FALSE(same(plain, gains));
  EXPECT_TRUE(same(start, bare)) << "nothing is known yet";
  EXPECT_TRUE(same(start, shot("begin.png", std::string(kTwoScans) + "--at 0 " + kSmall)));
  for (const char* camera : {"follow", "robot"}) {
    const auto other =
        shot(camera + std::string(".png"), std::string("run --camera ") + camera + " " + kSmall);
    EXPECT_GT(colours(other), 100U) << camera;
    EXPECT_FALSE(same(plain, other)) << camera;
  }
}

TEST_F(View, TheStoryAgreesWithTheMetrics) {
  ASSERT_EQ(vantage(std::string("run -q --out run ") + kTwoScans).exit_code, 0);
  const auto metrics = nlohmann::json::parse(read_file(folder_ / "run/metrics.json"));
  const auto frame = std::get<Tabletop>(load_recorded(folder_ / "run").task).map.frame();
  const auto event_log = read_event_log(folder_ / "run/story.bin", frame.size());
  EventReplay moment(frame);
  std::size_t decisions = 0;
  for (std::size_t i = 0; i < event_log.size(); ++i) {
    moment.go_to(event_log, i + 1);
    if (std::holds_alternative<MapChange>(event_log[i].what)) {
      EXPECT_EQ(moment.grid().count(CellState::unobserved),
                metrics["scans"][moment.scans() - 1]["unobserved_cells"]);
    }
    if (std::holds_alternative<Decision>(event_log[i].what)) {
      const auto& scan = metrics["scans"][++decisions];
      EXPECT_EQ(moment.decision()->candidates[moment.decision()->chosen].id, scan["chosen_view"]);
      EXPECT_EQ(moment.decision()->candidates.size(), scan["candidates"]);
    }
  }
  EXPECT_EQ(moment.scans(), 2U);
  EXPECT_EQ(decisions, 1U);
  ASSERT_EQ(vantage(std::string("run -q --lean --out lean ") + kTwoScans).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "lean/story.bin"));
}

TEST_F(View, AUserClosesALiveEpisode) {
  const VirtualDisplay display;
  auto running = std::async(std::launch::async, [&] {
    return vantage("view --out run --set laser.scan_duration_s=3600 " + std::string(kSmall));
  });
  DesktopUser user(display, "vantage: tabletop");
  for (const char* key : {"m", "g", "h", "c", "plus", "space", "period", "space"}) user.press(key);
  user.drag(1, {100, 100}, {160, 120});
  user.turn_wheel(true);
  user.close();
  const Result result = running.get();
  EXPECT_EQ(result.exit_code, 130) << result.output;
  EXPECT_THAT(read_file(folder_ / "run/metrics.json"), HasSubstr("\"status\": \"interrupted\""));
  EXPECT_EQ(vantage("replay run").exit_code, 0);
  for (const auto& entry : fs::directory_iterator(folder_)) {
    EXPECT_NE(entry.path().extension(), ".png") << entry.path() << ": no picture was asked for";
  }
}

TEST_F(View, AUserLooksAtARecording) {
  const VirtualDisplay display;
  ASSERT_EQ(vantage(std::string("run -q --out run ") + kTwoScans).exit_code, 0);
  auto running =
      std::async(std::launch::async, [&] { return vantage(std::string("view run ") + kSmall); });
  DesktopUser user(display, "vantage: run");
  const auto written = [&] {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      const std::string name = entry.path().filename().string();
      if (name.ends_with("s.png")) names.insert(name);
    }
    return names;
  };
  user.press("space");
  while (written().empty()) user.press("s");  // there may be no image to take yet
  const auto first = written();
  user.press("End");
  while (written() == first) user.press("s");
  for (const std::string& name : written()) fs::remove(folder_ / name);
  const auto comes = [&](const std::vector<const char*>& times_s) {
    const auto is_there = [&](const char* time_s) {
      return fs::exists(folder_ / fmt::format("vantage-view-{}s.png", time_s));
    };
    for (int i = 0; i < 1500 && std::ranges::none_of(times_s, is_there); ++i) user.press("s");
    return std::ranges::any_of(times_s, is_there);
  };
  user.press("Home");
  EXPECT_TRUE(comes({"0.00"}));
  user.press("period");
  EXPECT_TRUE(comes({"0.02", "0.03"})) << "a tick of 0.025 s on";
  EXPECT_FALSE(fs::exists(folder_ / "vantage-view-0.05s.png"));
  user.press("q");
  EXPECT_EQ(running.get().exit_code, 0);
}

TEST_F(View, SignalsEndIt) {
  const VirtualDisplay display;
  ASSERT_EQ(vantage(std::string("run -q --out run ") + kTwoScans).exit_code, 0);
  const std::string timeout =
      "cd '" + folder_.string() + "' && timeout --preserve-status -s TERM 4 " VANTAGE_BINARY;
  EXPECT_EQ(shell(timeout + " view run " + kSmall).exit_code, 143);
  const Result live = shell(timeout + " view --set scans=100 " + kSmall);
  EXPECT_EQ(live.exit_code, 143) << live.output;
}

TEST_F(View, AScreenshotNeedsNoDisplay) {
  const std::string arguments = std::string(" view ") + kTwoScans + kSmall + "--at 1 --screenshot ";
  const Result result =
      shell("cd '" + folder_.string() + "' && env -u DISPLAY -u WAYLAND_DISPLAY " VANTAGE_BINARY +
            arguments + "no_display.png");
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const auto drawn = cv::imread((folder_ / "no_display.png").string(), cv::IMREAD_COLOR);
  ASSERT_EQ(drawn.size(), cv::Size(400, 300));
  EXPECT_GT(cv::mean(drawn)[1], 60.0);
  const VirtualDisplay display;
  EXPECT_TRUE(same(drawn, shot("display.png", std::string(kTwoScans) + kSmall + "--at 1")));
}

TEST_F(View, WithoutADisplay) {
  expect_error(shell("env -u DISPLAY -u WAYLAND_DISPLAY " VANTAGE_BINARY " view"), 6,
               {"no display", "DISPLAY"});
  expect_error(shell("DISPLAY=:98765 " VANTAGE_BINARY " view"), 6, {":98765"});
}

TEST_F(View, WhatCannotBeShown) {
  const VirtualDisplay display;
  expect_error(vantage("view nowhere.yaml"), 3, {"nowhere.yaml"});
  fs::create_directories(folder_ / "empty");
  expect_error(vantage("view empty"), 3, {"config.yaml"});
  expect_error(vantage("view empty --seed 3"), 2, {"--seed", "empty"});
  EXPECT_EQ(vantage("view --size 12").exit_code, 2);
  EXPECT_EQ(vantage("view --at 3").exit_code, 2);
  EXPECT_EQ(vantage("view --camera front").exit_code, 2);
  expect_error(vantage("view --screenshot shot"), 2, {"--screenshot", "shot", ".png"});
  expect_error(vantage("view --screenshot shot.jpg"), 2, {"--screenshot", "shot.jpg", ".png"});
  const auto scene = file(
      "bare.xml", "<mujoco><worldbody><geom type='plane' size='5 5 .1'/></worldbody></mujoco>");
  const Result bare = vantage(std::string("view --screenshot x.png ") + kTwoScans + kSmall +
                              "--set scene=" + scene);
  EXPECT_EQ(bare.exit_code, 3) << bare.output;
  EXPECT_THAT(bare.output, HasSubstr("no table"));

  ASSERT_EQ(vantage(std::string("run -q --out run ") + kTwoScans).exit_code, 0);
  const std::string event_log = read_file(folder_ / "run/story.bin");
  write_file(folder_ / "run/story.bin", event_log.substr(0, event_log.size() - 1));
  expect_error(vantage("view run --screenshot x.png"), 3, {"story.bin"});
  fs::remove(folder_ / "run/story.bin");
  const Result old = vantage(std::string("view run --map --screenshot x.png ") + kSmall);
  EXPECT_EQ(old.exit_code, 0) << old.output;
  EXPECT_THAT(old.output, HasSubstr("story.bin: missing"));
  EXPECT_EQ(vantage("view run --screenshot run/none/x.png").exit_code, 5);
  fs::remove(folder_ / "run/states.bin");
  expect_error(vantage("view run"), 3, {"states.bin"});
}

}  // namespace
}  // namespace vantage
