/// Renders a dataset of objects on a turntable in the layout of the RGB-D Object Dataset.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "vantage/dataset/dataset_options.hpp"

namespace vantage {

struct DatasetRun {
  std::filesystem::path root;
  int jobs = 1;  ///< processes of `worker`
  /// Program and arguments that call serve_rendering(STDIN_FILENO); a name without / is not looked
  /// for. Empty: one object after the other is rendered in this process.
  std::vector<std::string> worker = {};
  bool overwrite = false;  ///< begin anew what other options made in that folder
  /// Asked before each view if this process renders, else several times a second.
  std::function<bool()> stop = [] { return false; };
  /// Called as objects are complete, those that were there first; empty: a bar of its own.
  std::function<void(int objects, int of, const std::string& object)> tell = {};
};

struct DatasetOutcome {
  int objects = 0;   ///< complete now
  int rendered = 0;  ///< of these, in this call
  int views = 0;     ///< rendered in this call, of complete objects
  bool stopped = false;
};

/// Views of every object at the elevations of its videos, 30, 45 or 60 deg, a step of the
/// turntable apart. The pose of a view is the object's yaw, counter-clockwise seen from above; at
/// yaw 0 the camera sees its +x side. The files depend on the options alone, not on `jobs`.
///
/// The options are kept in <root>/dataset.yaml. An object's folder is either complete or not there,
/// so that a call with the same options (or more objects) goes on where another one ended.
/// @throws ConfigError if an option is out of range, or the folder holds something else or was
/// rendered with other options; InputError as object_names and Turntable; OutputError, also if
/// another process renders into that folder; RendererError; Error with the code of one of these, as
/// a process failed.
DatasetOutcome render_dataset(const DatasetOptions& options, const DatasetRun& run);

/// The options a dataset of ours was rendered with, as YAML; empty for others.
std::string dataset_options_text(const std::filesystem::path& root);

/// Objects that a dataset of ours shall have and has not, since its rendering was broken off; none
/// of other folders, or if the objects to render are not there any more.
/// @throws ConfigError if what it was rendered with cannot be read.
std::vector<std::string> missing_objects(const std::filesystem::path& root);

}  // namespace vantage
