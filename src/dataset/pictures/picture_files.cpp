#include "vantage/dataset/pictures/picture_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "vantage/core/error.hpp"
#include "vantage/perception/images/image_files.hpp"
#include "vantage/perception/picture_notes.hpp"

namespace vantage {
namespace fs = std::filesystem;
namespace {

using Kind = PictureFileKind;

Kind kind_of_word(const std::string& word) {
  static const std::map<std::string, Kind> kinds{
      {"rgb", Kind::colour},        {"color", Kind::colour},  {"colour", Kind::colour},
      {"image", Kind::colour},      {"images", Kind::colour}, {"img", Kind::colour},
      {"crop", Kind::colour},       {"depth", Kind::depth},   {"depthcrop", Kind::depth},
      {"depths", Kind::depth},      {"dpt", Kind::depth},     {"mask", Kind::mask},
      {"masks", Kind::mask},        {"maskcrop", Kind::mask}, {"seg", Kind::mask},
      {"segmentation", Kind::mask}, {"pose", Kind::pose},     {"poses", Kind::pose}};
  const auto found = kinds.find(lower(word));
  return found == kinds.end() ? Kind::none : found->second;
}

/// A file with the words of its kind taken out of its path.
struct Piece {
  fs::path file;
  Kind kind = Kind::none;
  Words folders;
  Words leaf;
  std::string path;  ///< below the root, without extension

  [[nodiscard]] std::string key() const {
    return fmt::format("{}|{}", fmt::join(folders, "/"), joined_words(leaf));
  }
};

Kind kind_by_content(const fs::path& file) {
  switch (image_kind(file)) {
    case ImageKind::colour: return Kind::colour;
    case ImageKind::depth: return Kind::depth;
    case ImageKind::mask: return Kind::mask;
    case ImageKind::other: break;
  }
  return Kind::none;
}

Piece piece_of(const fs::path& root, const fs::path& file) {
  Piece piece{.file = file, .kind = Kind::none, .folders = {}, .leaf = {}, .path = {}};
  fs::path relative = fs::relative(file, root);
  relative.replace_extension();
  piece.path = relative.generic_string();
  for (const fs::path& part : relative.parent_path()) {
    const Kind kind = kind_of_word(part.string());
    piece.kind = std::max(piece.kind, kind);
    if (kind == Kind::none) piece.folders.push_back(part.string());
  }
  for (const std::string& word : words_of(relative.filename().string())) {
    const Kind kind = kind_of_word(word);
    piece.kind = std::max(piece.kind, kind);
    if (kind == Kind::none) piece.leaf.push_back(word);
  }
  if (piece.leaf.empty() && !piece.folders.empty()) {
    piece.leaf = words_of(piece.folders.back());
    piece.folders.pop_back();
  }
  const std::string extension = lower(file.extension().string());
  if (extension == ".txt") {
    piece.kind = piece.kind == Kind::pose ? Kind::pose : Kind::none;
  } else if (const Kind content = kind_by_content(file);
             piece.kind == Kind::none || content == Kind::none || piece.kind == Kind::pose) {
    piece.kind = content;
  } else if (content == Kind::depth && piece.kind == Kind::colour) {
    piece.kind = Kind::depth;  // "image_1.npy"
  }
  return piece;
}

bool is_candidate(const fs::path& file) {
  const std::string extension = lower(file.extension().string());
  constexpr std::array kExtensions{".png", ".jpg",  ".jpeg", ".bmp", ".ppm",
                                   ".tif", ".tiff", ".npy",  ".txt"};
  return std::ranges::find(kExtensions, extension) != kExtensions.end();
}

std::vector<Piece> pieces_below(const fs::path& root) {
  std::error_code error;
  if (!fs::is_directory(root, error)) {
    throw InputError(fmt::format("{}: no such folder of pictures", root.string()));
  }
  std::vector<fs::path> files;
  std::error_code failed;
  for (fs::recursive_directory_iterator it(root, failed), end; !failed && it != end;
       it.increment(failed)) {
    // What was imported before is no picture of the user's.
    if (it->is_directory(error) && fs::exists(it->path() / kPictureNotes, error)) {
      it.disable_recursion_pending();
    } else if (it->is_regular_file(error) && is_candidate(it->path())) {
      files.push_back(it->path());
    }
  }
  if (failed) throw InputError(fmt::format("{}: {}", root.string(), failed.message()));
  std::ranges::sort(files);
  std::vector<Piece> pieces;
  for (const fs::path& file : files) {
    Piece piece = piece_of(root, file);
    if (piece.kind != Kind::none && !piece.leaf.empty()) pieces.push_back(std::move(piece));
  }
  return pieces;
}

}  // namespace

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

Words words_of(const std::string& text) {
  Words words(1);
  for (const char c : text) {
    if (c == '_' || c == '-' || c == ' ' || c == '.') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  std::erase(words, "");
  return words;
}

std::string joined_words(const Words& words) { return fmt::format("{}", fmt::join(words, "_")); }

std::vector<PictureFiles> picture_files_below(const fs::path& root,
                                              std::vector<std::string>& left_out) {
  std::map<std::string, PictureFiles> groups;
  for (const Piece& piece : pieces_below(root)) {
    PictureFiles& group = groups[piece.key()];
    group.files[piece.kind].push_back(piece.file);
    if (piece.kind == Kind::colour) group.path = piece.path;
    group.folders = piece.folders;
    group.leaf = piece.leaf;
  }
  std::vector<PictureFiles> whole;
  for (auto& [key, group] : groups) {
    const bool colour = group.files.contains(Kind::colour);
    const bool depth = group.files.contains(Kind::depth);
    if (colour && depth) {
      whole.push_back(std::move(group));
    } else if (colour || depth) {
      left_out.push_back(fmt::format("{}: has no {} beside it",
                                     group.files.begin()->second.front().string(),
                                     colour ? "depth" : "colour"));
    }
  }
  if (!whole.empty()) return whole;
  throw InputError(fmt::format(
      "{}: no colour and depth that belong together; name them alike but for a word, as "
      "front_rgb.png and front_depth.png, or put them into folders rgb and depth",
      root.string()));
}

}  // namespace vantage
