#include <fmt/format.h>

#include <algorithm>

#include "vantage/core/log.hpp"
#include "vantage/runtime/interrupt.hpp"
#include "vantage/runtime/log/recording.hpp"
#include "vantage/view/session.hpp"

namespace vantage {
namespace {

/// Positions are the recorded states, and one more: the last state with all that followed it.
struct RecordedPlayer {
  RecordedStates states;
  std::vector<EpisodeEvent> event_log;
  double tick_s = 0.0;

  [[nodiscard]] std::size_t end() const { return states.count(); }
  [[nodiscard]] std::size_t state_at(std::size_t position) const {
    return std::min(position, states.count() - 1);
  }
  [[nodiscard]] double time_s(std::size_t position) const {
    return states.state(state_at(position))[0];
  }
  /// The first position at that time or later.
  [[nodiscard]] std::size_t position_at(double wanted_s) const {
    std::size_t low = 0;
    std::size_t high = end();
    while (low < high) {
      const std::size_t middle = low + (high - low) / 2;
      if (time_s(middle) < wanted_s - 1e-9) {
        low = middle + 1;
      } else {
        high = middle;
      }
    }
    return low;
  }
  [[nodiscard]] std::size_t events_at(std::size_t position) const {
    if (position == end()) return event_log.size();
    const auto after = std::ranges::lower_bound(event_log, position, {}, &EpisodeEvent::tick);
    return static_cast<std::size_t>(after - event_log.begin());
  }

  void play(ViewLink& link, PlaybackGate& gate, std::size_t position, bool still) const {
    for (const EpisodeEvent& event : event_log) link.tell(event);
    while (true) {
      const auto state = states.finite_state(state_at(position));
      if (still || position == end()) gate.pause();
      link.show({state.begin(), state.end()}, events_at(position), still);
      if (!gate.wait(tick_s)) return;
      const auto wanted_s = gate.take_seek();
      position = wanted_s ? position_at(*wanted_s) : std::min(position + 1, end());
    }
  }
};

/// Runs of before there were event logs can still be looked at.
std::vector<EpisodeEvent> event_log_of(const std::filesystem::path& run_dir,
                                       const std::optional<GridFrame>& map) {
  const auto path = run_dir / "story.bin";
  if (std::filesystem::exists(path)) return read_event_log(path, map ? map->size() : 0);
  log_warning(path.string() + ": missing; there is neither map nor gains to show");
  return {};
}

/// "tabletop-1" of out/tabletop-1/.
std::string name_of(const std::filesystem::path& run_dir) {
  return std::filesystem::weakly_canonical(run_dir).filename().string();
}

}  // namespace

ExitCode view_recording(const std::filesystem::path& run_dir, const ViewOptions& options) {
  const ResolvedEpisode resolved = load_recorded(run_dir);
  RecordedPlayer recorded;
  const World world(model_source(resolved), resolved.setup.options.simulation);
  recorded.states = load_states(run_dir, world);
  recorded.event_log = event_log_of(run_dir, window(resolved).map);
  recorded.tick_s = resolved.setup.options.simulation.control_period_s;
  const bool still = !options.screenshot.empty();
  std::size_t first = still ? recorded.end() : 0;
  if (options.at_s) first = recorded.position_at(*options.at_s);
  const auto player = [&](ViewLink& link, PlaybackGate& gate) {
    recorded.play(link, gate, first, still);
    return interrupt_signal() == 0 ? ExitCode::done : Interrupted(interrupt_signal()).code();
  };
  return show({resolved, "vantage: " + name_of(run_dir), recorded.time_s(recorded.end())}, options,
              player);
}

}  // namespace vantage
