/// `vantage view`: an episode in a window, as it runs or from its recording.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vantage/sim/render/window.hpp"
#include "vantage/tasks/run.hpp"
#include "vantage/view/link.hpp"

namespace vantage {

struct ViewOptions {
  PixelSize size{1280, 720};
  ViewCamera camera = ViewCamera::overview;
  bool map = false;    ///< shown from the beginning
  bool gains = false;  ///< shown from the beginning
  /// Not empty: an image of the window goes there, and that is all.
  std::filesystem::path screenshot;
  std::optional<double> at_s;  ///< simulated, of that image; else the end
};

/// Runs the episode as run() does, at the pace of the viewer, into `run_options.directory`; if that
/// is empty nothing is kept. Closing the window interrupts the episode.
/// @return the run's exit code
/// @throws RendererError if no window can be opened, and what run() throws
ExitCode view_live(const ResolvedEpisode& resolved, const ViewOptions& options,
                   const RunOptions& run_options);

/// Plays the states of a run folder.
/// @throws RendererError, InputError if the folder lacks a file or one is damaged
ExitCode view_recording(const std::filesystem::path& run_dir, const ViewOptions& options);

}  // namespace vantage
