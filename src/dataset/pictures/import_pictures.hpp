/// From a folder of a user's own pictures to a dataset that can be trained on.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "vantage/perception/picture_notes.hpp"

namespace vantage {

struct ImportOptions {
  std::string layout;         ///< of the paths, see LayoutPattern; empty: found out
  std::string cut = "auto";   ///< `mask`, `depth`, `whole`; auto: masks if all have one
  double depth_unit_m = 0.0;  ///< what 1 in a depth file stands for; 0: found out
  std::optional<double> focal_px;
  /// Principal point of the camera's whole image; nothing: the middle of each picture. A picture
  /// that does not have it about its middle is taken for a crop of the image's middle.
  std::optional<std::array<double, 2>> centre_px;
  std::optional<double> elevation_deg;    ///< of the camera, where no pose tells
  std::map<std::string, double> yaw_deg;  ///< of views by name, beside or instead of the usual ones
  int bins = 0;                           ///< viewing directions of an object; 0: as they are
};

struct ImportRun {
  std::vector<std::filesystem::path> from;  ///< folders; of several each is a recording
  std::filesystem::path root;               ///< of the dataset
  int jobs = 1;
  bool overwrite = false;
  bool skip_bad = false;               ///< leave bad pictures out instead of failing
  std::function<void()> poll = [] {};  ///< ends the work by throwing
};

struct ImportOutcome {
  int objects = 0;
  int pictures = 0;
  PictureNotes notes;
  std::vector<std::string> layouts;   ///< how the paths of each folder were read
  std::vector<std::string> views;     ///< names that occur
  std::map<double, int> units;        ///< pictures by what 1 in their depth stands for, m
  std::vector<std::string> notices;   ///< what was assumed, and what to give instead
  std::vector<std::string> left_out;  ///< files and why
};

/// Reads the pictures, cuts the object out of each and writes them in the layout of
/// dataset_index.hpp, with notes. The folder is there when it is whole.
/// @throws ConfigError if an option makes no sense; InputError naming the first picture that cannot
/// be used and how many there are; OutputError; what `poll` throws.
ImportOutcome import_pictures(const ImportOptions& options, const ImportRun& run);

}  // namespace vantage
