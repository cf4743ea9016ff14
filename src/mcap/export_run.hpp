/// `vantage export`: a run folder as an MCAP file of Foxglove's well-known schemas.
#pragma once

#include <cstddef>
#include <filesystem>

namespace vantage {

struct ExportOptions {
  double image_period_s = 1.0;  ///< of simulated time; 0: no images
  int image_height_px = 240;
};

struct ExportedRun {
  std::size_t channels = 0;
  std::size_t messages = 0;
  double end_s = 0.0;  ///< simulated time of the last state
};

/// @throws InputError if the folder is no whole run, OutputError, RendererError; Interrupted leaves
/// no file
ExportedRun export_run(const std::filesystem::path& run_dir, const std::filesystem::path& file,
                       const ExportOptions& options);

}  // namespace vantage
