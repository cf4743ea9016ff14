/// The window of `vantage view` and the threads behind it.
#pragma once

#include <functional>

#include "vantage/sim/world/world.hpp"
#include "vantage/view/playback_gate.hpp"
#include "vantage/view/view.hpp"

namespace vantage {

/// Gives moments to the link, one per passing of the gate, until the gate closes or there are no
/// more. In a screenshot's way it marks the moment to take as still, and then waits at the gate.
using Player = std::function<ExitCode(ViewLink&, PlaybackGate&)>;

/// What is shown: `world` for the painter alone; the duration of a recording.
struct ViewSubject {
  const ResolvedEpisode& resolved;
  std::string title;
  std::optional<double> duration_s;
};

/// Opens the window and shows what `player` plays until somebody closes it, or the screenshot is
/// taken.
/// @return what the player returned; done if it was only ended by the screenshot
/// @throws RendererError, OutputError, and what the player throws
ExitCode show(const ViewSubject& subject, const ViewOptions& options, const Player& player);

}  // namespace vantage
