// How a screenshot's session ends, by what its player came to.
#include "vantage/view/session.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <filesystem>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <system_error>

#include "tests/support/temporary_directory.hpp"
#include "tests/support/virtual_display.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/tasks/episode.hpp"
#include "vantage/view/painter.hpp"

namespace vantage {
namespace {

/// Shows the beginning of an episode until the screenshot is taken, then ends as `end` does.
ExitCode shown(const std::filesystem::path& screenshot, const std::function<ExitCode()>& end) {
  const ResolvedEpisode resolved = resolve_episode(parse_yaml("scans: 2", "e.yaml"), "e.yaml");
  const auto state = World(model_source(resolved), resolved.setup.options.simulation).state();
  const Player player = [&](ViewLink& link, PlaybackGate& gate) {
    gate.pause();
    link.show(state, 0, true);
    EXPECT_FALSE(gate.wait(0.025)) << "there is no further tick";
    return end();
  };
  ViewOptions options;
  options.size = {64, 48};
  options.screenshot = screenshot;
  return show({resolved, "title", std::nullopt}, options, player);
}

TEST(ViewSession, EndsAsItsPlayerDoes) {
  const support::TemporaryDirectory folder;
  const auto file = folder / "shot.png";
  EXPECT_EQ(shown(file, [] { return ExitCode::interrupted; }), ExitCode::done)
      << "only the screenshot ended it";
  EXPECT_TRUE(std::filesystem::exists(file));
  EXPECT_EQ(shown(file, [] { return ExitCode::goal_failed; }), ExitCode::goal_failed);
  EXPECT_THROW(shown(file, []() -> ExitCode { throw OutputError("at the very end"); }),
               OutputError);
}

TEST(ViewSession, AWindowClosesWhereItsPlayerFails) {
  const support::VirtualDisplay display;
  const ResolvedEpisode resolved = resolve_episode(parse_yaml("scans: 2", "e.yaml"), "e.yaml");
  const Player player = [](ViewLink&, PlaybackGate&) -> ExitCode {
    throw OutputError("on the way");
  };
  ViewOptions options;
  options.size = {64, 48};
  EXPECT_THROW(show({resolved, "title", std::nullopt}, options, player), OutputError);
}

/// Pictures that are taken of a window go there.
class WorkingFolder {
 public:
  explicit WorkingFolder(const std::filesystem::path& folder) {
    std::filesystem::current_path(folder);
  }
  WorkingFolder(const WorkingFolder&) = delete;
  WorkingFolder& operator=(const WorkingFolder&) = delete;
  ~WorkingFolder() {
    std::error_code error;
    std::filesystem::current_path(before_, error);
  }

 private:
  std::filesystem::path before_ = std::filesystem::current_path();
};

cv::Mat session_bgr(const RenderedImages& image) {
  cv::Mat bgr(image.height_px, image.width_px, CV_8UC3);
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) {
      const auto i = static_cast<std::size_t>(3 * (image.width_px * y + x));
      bgr.at<cv::Vec3b>(y, x) = cv::Vec3b(image.rgb[i + 2], image.rgb[i + 1], image.rgb[i]);
    }
  }
  return bgr;
}

/// A moment that a window shows.
struct PlayedMoment {
  const char* key = nullptr;  ///< that a user presses
  std::optional<double> duration_s = {};
  bool ends = false;   ///< its player, by itself
  bool helps = false;  ///< with the help over it, if told so
};

/// Whether a picture of the window comes to be nearer to that with `told` in its corner than to
/// that with `untold`, which is shorter: then one without either is not.
bool window_tells(const support::VirtualDisplay& display, const std::string& told,
                  const std::string& untold, const PlayedMoment& moment) {
  const support::TemporaryDirectory folder;
  const WorkingFolder here(folder.path());
  const ResolvedEpisode resolved = resolve_episode(parse_yaml("scans: 2", "e.yaml"), "e.yaml");
  World world(model_source(resolved), resolved.setup.options.simulation);
  const auto state = world.state();
  const auto file = folder / fmt::format("vantage-view-{:.2f}s.png", world.time_s());
  ViewOptions options;
  options.size = {400, 300};
  const auto image_with = [&](const std::string& playback, bool help) {
    ViewPainter painter(world, {method_name(resolved.task), window(resolved)});
    ViewLink::Work work;
    work.moment = {state, 0, false};
    work.controls.size = options.size;
    work.controls.overview = overview_of(world, window(resolved));
    work.controls.playback = playback;
    work.controls.help = help;
    work.controls.duration_s = moment.duration_s;
    return session_bgr(painter.paint(work).image);
  };
  // Where there is a window, nothing else may draw in its thread.
  const cv::Mat with = std::async(std::launch::async, image_with, told, moment.helps).get();
  const cv::Mat without = std::async(std::launch::async, image_with, untold, false).get();
  auto user = std::async(std::launch::async, [&] {
    support::DesktopUser desktop(display, "title");
    if (moment.key != nullptr) desktop.press(moment.key);
    bool found = false;
    for (int i = 0; i < 250 && !found; ++i) {
      desktop.press("s");
      if (!std::filesystem::exists(file)) continue;
      const cv::Mat picture = cv::imread(file.string());
      found = picture.size() == with.size() && cv::norm(picture, with) < cv::norm(picture, without);
    }
    desktop.press("q");
    return found;
  });
  const Player player = [&](ViewLink& link, PlaybackGate& gate) {
    link.show(state, 0, false);
    while (!moment.ends && gate.wait(0.025)) {
    }
    return ExitCode::done;
  };
  EXPECT_EQ(show({resolved, "title", moment.duration_s}, options, player), ExitCode::done);
  return user.get();
}

TEST(ViewSession, TheWindowTellsHowItIsPlayed) {
  const support::VirtualDisplay display;
  EXPECT_TRUE(
      window_tells(display, "live    ended    h: help", "live    1 x    h: help", {.ends = true}));
  EXPECT_TRUE(window_tells(display, "live    paused    h: help", "live    1 x    h: help",
                           {.key = "space"}));
  EXPECT_TRUE(window_tells(display, "recording    0.5 x    h: help", "recording    1 x    h: help",
                           {.key = "minus", .duration_s = 10.0}));
}

TEST(ViewSession, TheWindowShowsWhatAKeyAsksFor) {
  const support::VirtualDisplay display;
  EXPECT_TRUE(window_tells(display, "live    1 x    h: help", "live    1 x    h: help",
                           {.key = "h", .helps = true}));
  EXPECT_TRUE(window_tells(display, "live    paused    h: help", "live    ended    h: help",
                           {.key = "space"}));
}

}  // namespace
}  // namespace vantage
