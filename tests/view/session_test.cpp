// How a screenshot's session ends, by what its player came to.
#include "vantage/view/session.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "tests/support/temporary_directory.hpp"
#include "tests/support/virtual_display.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/tasks/episode.hpp"

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

}  // namespace
}  // namespace vantage
