/// Renders a dataset of objects on a turntable in the layout of the RGB-D Object Dataset.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "vantage/dataset/dataset_options.hpp"

namespace vantage {

struct DatasetRun {
  std::filesystem::path root;
  int jobs = 1;            ///< threads, each with an OpenGL context of its own
  bool overwrite = false;  ///< begin anew what other options made in that folder
  std::function<bool()> stop = [] { return false; };  ///< asked before each view, by any thread
};

struct DatasetOutcome {
  int objects = 0;   ///< complete now
  int rendered = 0;  ///< of these, in this call
  int views = 0;     ///< rendered in this call, of complete objects
  bool stopped = false;
};

/// Views of every object at elevations of 30, 45 and 60 deg (videos 1, 2, 4), a step of the
/// turntable apart. The pose of a view is the object's yaw, counter-clockwise seen from above; at
/// yaw 0 the camera sees its +x side. The files depend on the options alone, not on `jobs`.
///
/// The options are kept in <root>/dataset.yaml. An object's folder is either complete or not there,
/// so that a call with the same options (or more objects) goes on where another one ended.
/// @throws ConfigError if an option is out of range, or the folder holds something else or was
/// rendered with other options; InputError as object_names and Turntable; OutputError;
/// RendererError.
DatasetOutcome render_dataset(const DatasetOptions& options, const DatasetRun& run);

/// The options a dataset of ours was rendered with, as YAML; empty for others.
std::string dataset_options_text(const std::filesystem::path& root);

}  // namespace vantage
