/// What a folder of pictures says of itself: <root>/pictures.yaml, written by an import.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vantage/core/fields.hpp"

namespace vantage {

struct PictureNotes {
  std::string cut = "mask";
  double focal_px = 570.3;
  std::array<double, 2> centre_px{320.0, 240.0};
  std::vector<std::string> recordings;
  int bins = 8;
  std::vector<std::string> views;
  bool degrees = true;
  void fields(auto&& f) {
    f("cut", cut, "how the object was told from its surroundings: `mask`, `depth` or `whole`");
    f("focal_px", focal_px, "focal length of the camera", above(0.0));
    f("centre_px", centre_px, "principal point of the camera in its whole image, x and y");
    f("recordings", recordings, "names of the recordings; in file names they are numbers from 1");
    f("bins", bins, "number of viewing directions of an object", between(2, 3600));
    f("views", views,
      "names of the viewing directions, one a bin; empty where a bin has none; empty list: no "
      "names");
    f("degrees", degrees,
      "true: directions are angles of the turntable; false: they are names, in a circle of their "
      "own");
  }
  void check() const;  ///< cut is one of the three; a name a bin, or none
};

inline constexpr auto kPictureNotes = "pictures.yaml";

/// Of the folder; nothing if it has none, as a rendered dataset.
/// @throws ConfigError naming file and key if they are not in order.
std::optional<PictureNotes> read_picture_notes(const std::filesystem::path& root);

/// As YAML, and back. @param where for messages
std::string to_text(const PictureNotes& notes);
PictureNotes picture_notes_of(const std::string& text, const std::string& where);

/// The bin of the view of that name, whatever its letters' case; nothing if there is none.
std::optional<int> bin_of_view(const PictureNotes& notes, std::string_view name);

}  // namespace vantage
