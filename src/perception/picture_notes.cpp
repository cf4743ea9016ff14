#include "vantage/perception/picture_notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/perception/object_cut.hpp"

namespace vantage {
namespace {

bool same_word(std::string_view a, std::string_view b) {
  return std::ranges::equal(
      a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

}  // namespace

void PictureNotes::check() const {
  object_cut_of(cut, "cut");
  if (!views.empty() && views.size() != static_cast<std::size_t>(bins)) {
    throw ConfigError(fmt::format("views: {} names for {} bins", views.size(), bins));
  }
}

std::optional<PictureNotes> read_picture_notes(const std::filesystem::path& root) {
  const auto file = root / kPictureNotes;
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return std::nullopt;
  return picture_notes_of(read_file(file), file.string());
}

std::string to_text(const PictureNotes& notes) { return to_yaml(write_node(notes)); }

PictureNotes picture_notes_of(const std::string& text, const std::string& where) {
  PictureNotes notes;
  read_into(parse_yaml(text, where), notes, {});
  return notes;
}

std::optional<int> bin_of_view(const PictureNotes& notes, std::string_view name) {
  const auto found = std::ranges::find_if(
      notes.views, [&](const std::string& view) { return same_word(view, name); });
  if (name.empty() || found == notes.views.end()) return std::nullopt;
  return static_cast<int>(found - notes.views.begin());
}

}  // namespace vantage
