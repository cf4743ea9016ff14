#include "vantage/sim/world/mjcf_files.hpp"

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

#include "vantage/core/atomic_file.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

using TextPair = std::pair<std::string_view, std::string_view>;
constexpr std::array<TextPair, 2> kNoTags{{{"<!--", "-->"}, {"<![CDATA[", "]]>"}}};
/// The ampersand last: what it leaves is no entity.
constexpr std::array<TextPair, 5> kEntities{
    {{"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&apos;", "'"}, {"&amp;", "&"}}};

std::string decoded(std::string_view value) {
  std::string text(value);
  for (const auto& [entity, sign] : kEntities) {
    for (auto at = text.find(entity); at != text.npos; at = text.find(entity, at + 1)) {
      text.replace(at, entity.size(), sign);
    }
  }
  return text;
}

/// "name" of a text that ends in `name = `.
std::string_view name_at_end(std::string_view text) {
  text = text.substr(0, text.find_last_not_of(" \t\r\n=") + 1);
  return text.substr(text.find_last_of(" \t\r\n\"'") + 1);
}

/// Behind what is no tag, if such a thing begins at `at`; else `at`.
std::size_t behind_no_tag(std::string_view mjcf, std::size_t at) {
  for (const auto& [opening, closing] : kNoTags) {
    if (mjcf.substr(at).starts_with(opening)) return mjcf.find(closing, at + opening.size());
  }
  return at;
}

/// Appends the attributes of the tag that begins at `at`. @returns its end
std::size_t read_tag(std::string_view mjcf, std::size_t at, std::vector<MjcfAttribute>& found) {
  constexpr std::string_view kStops = "\"'>";
  const auto element_end = std::min(mjcf.find_first_of(" \t\r\n/>", at + 1), mjcf.size());
  const std::string_view element = mjcf.substr(at + 1, element_end - at - 1);
  for (at = mjcf.find_first_of(kStops, element_end); at < mjcf.size() && mjcf[at] != '>';
       at = mjcf.find_first_of(kStops, at)) {
    const std::size_t end = mjcf.find(mjcf[at], at + 1);
    if (end == mjcf.npos) return end;
    found.push_back({element, name_at_end(mjcf.substr(0, at)), mjcf.substr(at + 1, end - at - 1)});
    at = end + 1;
  }
  return at;
}

/// What the MJCF files of a model say of others.
struct NamedFiles {
  std::set<std::string> folders{""};  ///< of meshes and textures
  std::set<std::string> names;
  std::vector<std::string> includes;
  bool without_folders = false;  ///< of a name counts what is behind its last slash
};

void collect(std::string_view mjcf, NamedFiles& named) {
  for (const MjcfAttribute& attribute : mjcf_attributes(mjcf)) {
    if (!attribute.names_file() && attribute.element != "compiler") continue;
    const std::string value = decoded(attribute.value);
    if (attribute.names_file() && attribute.element == "include") {
      named.includes.push_back(value);
    } else if (attribute.names_file()) {
      named.names.insert(value);
    } else if (attribute.name.ends_with("dir")) {  // meshdir, texturedir, assetdir
      named.folders.insert(value);
    } else if (attribute.name == "strippath") {
      named.without_folders = named.without_folders || value == "true";
    }
  }
}

}  // namespace

std::vector<MjcfAttribute> mjcf_attributes(std::string_view mjcf) {
  std::vector<MjcfAttribute> found;
  for (std::size_t at = mjcf.find('<'); at < mjcf.size(); at = mjcf.find('<', at)) {
    const std::size_t behind = behind_no_tag(mjcf, at);
    at = behind == at ? read_tag(mjcf, at, found) : behind;
  }
  return found;
}

std::set<fs::path> mjcf_files(const fs::path& main) {
  std::set<fs::path> found;
  const auto add = [&](const fs::path& file) {
    std::error_code error;
    return fs::is_regular_file(file, error) && found.insert(file).second;
  };
  const fs::path folder = main.parent_path();
  NamedFiles named;
  if (add(main.lexically_normal())) collect(read_file(main), named);
  for (std::size_t i = 0; i < named.includes.size(); ++i) {
    const fs::path file = (folder / named.includes[i]).lexically_normal();
    if (add(file)) collect(read_file(file), named);
  }
  for (const fs::path name : named.names) {
    for (const std::string& base : named.folders) {
      add((folder / base / name).lexically_normal());
      if (named.without_folders) add((folder / base / name.filename()).lexically_normal());
    }
  }
  return found;
}

}  // namespace vantage
