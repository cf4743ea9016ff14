#include <fmt/format.h>

#include <csignal>

#include "vantage/runtime/interrupt.hpp"
#include "vantage/runtime/scratch_folder.hpp"
#include "vantage/view/session.hpp"

namespace vantage {
namespace {

/// Shows every tick of an episode up to the still one, and lets it wait at the gate.
struct LivePlayer {
  ViewLink& link;
  PlaybackGate& gate;
  const ViewOptions& options;
  std::vector<double> state = {};
  bool still_shown = false;

  void tick(const World& world) {
    const bool begins = state.empty();
    state = world.state();
    if (!still_shown) {
      still_shown = options.at_s && world.time_s() >= *options.at_s - 1e-9;
      if (still_shown) gate.pause();
      if (still_shown || options.screenshot.empty()) link.show(state, link.events(), still_shown);
    }
    // An episode that has not begun cannot be interrupted yet.
    if (begins || gate.wait(world.options().control_period_s)) return;
    throw_if_interrupted();
    throw Interrupted(SIGINT);
  }
};

}  // namespace

ExitCode view_live(const ResolvedEpisode& resolved, const ViewOptions& options,
                   const RunOptions& run_options) {
  const auto player = [&](ViewLink& link, PlaybackGate& gate) {
    std::optional<ScratchFolder> scratch;
    RunOptions run_as = run_options;
    if (run_as.directory.empty()) {
      run_as.directory = scratch.emplace().path();
      run_as.lean = true;
    }
    LivePlayer live{link, gate, options};
    run_as.spectator.on_tick = [&](const World& world) { live.tick(world); };
    run_as.spectator.on_event = [&](const EpisodeEvent& event) { link.tell(event); };
    const ExitCode code = run(resolved, run_as).code;
    if (!live.still_shown) link.show(live.state, link.events(), !options.screenshot.empty());
    return code;
  };
  return show({resolved, "vantage: " + resolved.setup.name, std::nullopt}, options, player);
}

}  // namespace vantage
