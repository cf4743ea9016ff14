/// Files of pictures, told apart by words of their paths and by what they hold.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace vantage {

using Words = std::vector<std::string>;

std::string lower(std::string text);
/// Parted at `_`, `-`, `.` and blanks.
Words words_of(const std::string& text);
/// Put together with `_`.
std::string joined_words(const Words& words);

enum class PictureFileKind { none, colour, depth, mask, pose };

/// Files of one picture: their paths differ by the words that tell their kind.
struct PictureFiles {
  std::map<PictureFileKind, std::vector<std::filesystem::path>>
      files;         ///< colour and depth at least
  std::string path;  ///< of the colour below the root, without extension
  Words folders;     ///< below the root, without those that tell a kind
  Words leaf;        ///< words of the name likewise; of the last folder if there are none
};

/// By path. @param left_out gets files that lack colour or depth, and why
/// @throws InputError if there is no such folder, or nothing in it belongs together.
std::vector<PictureFiles> picture_files_below(const std::filesystem::path& root,
                                              std::vector<std::string>& left_out);

}  // namespace vantage
