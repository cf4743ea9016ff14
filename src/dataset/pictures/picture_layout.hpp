/// The pictures in a folder of a user's own: which files belong together, and what they show.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vantage {

/// A picture's files and what their path says.
struct FoundPicture {
  std::filesystem::path colour;
  std::filesystem::path depth;
  std::optional<std::filesystem::path> mask;
  std::optional<std::filesystem::path> pose;
  std::string category;   ///< "mug"
  std::string object;     ///< "mug_1"
  std::string recording;  ///< empty: not told
  std::string view;       ///< "front"; empty: not told
  std::optional<double> yaw_deg;
  std::optional<double> elevation_deg;
};

struct FoundPictures {
  std::vector<FoundPicture> pictures;  ///< by path
  std::string layout;                  ///< how paths were read, for the user
  std::vector<std::string> left_out;   ///< files that are part of no picture, and why
};

/// Colour and depth lie beside each other under names, or in folders, that differ by a word: `rgb`,
/// `color`, `image`, ... against `depth`; masks and poses likewise. Without such words the files'
/// content tells.
/// @param layout pattern of paths below `root` (LayoutPattern); empty: found out
/// @throws InputError naming the folder and what to say if there are no pictures, or it is not
/// clear what their paths mean; naming two objects that would be called alike.
FoundPictures find_pictures(const std::filesystem::path& root, const std::string& layout);

}  // namespace vantage
