#include "vantage/dataset/pictures/picture_layout.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <set>
#include <utility>

#include "vantage/core/error.hpp"
#include "vantage/dataset/pictures/layout_pattern.hpp"
#include "vantage/dataset/pictures/picture_files.hpp"
#include "vantage/dataset/pictures/view_directions.hpp"

namespace vantage {
namespace fs = std::filesystem;
namespace {

using Kind = PictureFileKind;
using Group = PictureFiles;

/// Of several files of a kind the first, as of a mask in PNG and NPY.
FoundPicture picture_of(const Group& group) {
  FoundPicture picture;
  picture.colour = group.files.at(Kind::colour).front();
  picture.depth = group.files.at(Kind::depth).front();
  if (group.files.contains(Kind::mask)) picture.mask = group.files.at(Kind::mask).front();
  if (group.files.contains(Kind::pose)) picture.pose = group.files.at(Kind::pose).front();
  return picture;
}

double number_of(const std::string& text) {
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

void read_by_pattern(const LayoutPattern& pattern, const std::vector<Group>& groups,
                     FoundPictures& found) {
  for (const Group& group : groups) {
    const auto fields = pattern.match(group.path);
    if (!fields) {
      found.left_out.push_back(fmt::format("{}: not of the form of --layout",
                                           group.files.at(Kind::colour).front().string()));
      continue;
    }
    FoundPicture picture = picture_of(group);
    const auto field = [&](const char* name) {
      const auto value = fields->find(name);
      return value == fields->end() ? std::string() : value->second;
    };
    picture.category = field("category");
    picture.object = field("object");
    picture.recording = field("recording");
    picture.view = field("view");
    if (!field("yaw").empty()) picture.yaw_deg = number_of(field("yaw"));
    if (!field("elevation").empty()) picture.elevation_deg = number_of(field("elevation"));
    found.pictures.push_back(std::move(picture));
  }
}

bool is_number(const std::string& word) {
  return !word.empty() &&
         std::ranges::all_of(word, [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// "45deg", "yaw45".
std::optional<double> angle_in(const std::string& word) {
  std::string text = lower(word);
  bool marked = false;
  for (const std::string_view mark : {"yaw", "angle", "rot", "az"}) {
    if (text.starts_with(mark)) {
      text = text.substr(mark.size());
      marked = true;
    }
  }
  if (text.ends_with("deg")) {
    text.resize(text.size() - 3);
    marked = true;
  }
  if (!marked || !is_number(text)) return std::nullopt;
  return number_of(text);
}

/// The view in a file's words: the longest run that names a direction; it is taken out.
std::string take_view(Words& words) {
  for (std::size_t length = std::min<std::size_t>(3, words.size()); length > 0; --length) {
    for (std::size_t first = 0; first + length <= words.size(); ++first) {
      const auto begin = words.begin() + static_cast<std::ptrdiff_t>(first);
      const auto end = begin + static_cast<std::ptrdiff_t>(length);
      const std::string name = fmt::format("{}", fmt::join(begin, end, "_"));
      if (!named_direction(name)) continue;
      words.erase(begin, end);
      return lower(name);
    }
  }
  return {};
}

bool is_part_of(const std::string& part, const std::string& whole) {
  const Words a = words_of(lower(part)), b = words_of(lower(whole));
  return a.size() < b.size() && std::equal(a.begin(), a.end(), b.begin());
}

/// Values of each level of folders.
std::vector<std::set<std::string>> values_of(const std::vector<Group>& groups, std::size_t levels) {
  std::vector<std::set<std::string>> values(levels);
  for (const Group& group : groups) {
    for (std::size_t k = 0; k < levels; ++k) values[k].insert(group.folders[k]);
  }
  return values;
}

/// What the levels of folders mean, by index; -1: no level says it.
struct Levels {
  int object = -1;
  int category = -1;
  int recording = -1;
  int view = -1;
};

Levels levels_of(const fs::path& root, const std::vector<Group>& groups, std::size_t levels) {
  const auto values = values_of(groups, levels);
  std::vector<int> varied;
  Levels found;
  for (std::size_t k = 0; k < levels; ++k) {
    const auto level = static_cast<int>(k);
    const bool views = std::ranges::all_of(
        values[k], [](const auto& v) { return named_direction(v).has_value(); });
    if (views) {
      found.view = level;
    } else if (values[k].size() > 1) {
      varied.push_back(level);
    } else if (levels == 1) {
      found.object = level;
    }
  }
  if (varied.empty()) return found;
  const auto nests = [&](int outer, int inner) {
    return std::ranges::all_of(groups, [&](const Group& g) {
      return is_part_of(g.folders[static_cast<std::size_t>(outer)],
                        g.folders[static_cast<std::size_t>(inner)]);
    });
  };
  if (varied.size() >= 2 && nests(varied[varied.size() - 2], varied.back())) {
    found.category = varied[varied.size() - 2];
    found.object = varied.back();
    if (varied.size() == 3) found.recording = varied.front();
    return found;
  }
  if (varied.size() == 1) {
    found.object = varied.front();
    return found;
  }
  const auto count = [&](int level) { return values[static_cast<std::size_t>(level)].size(); };
  if (varied.size() > 2 || count(varied[0]) == count(varied[1])) {
    throw InputError(fmt::format(
        "{}: {} levels of folders, and it is not clear which is the object; say so with "
        "--layout, such as '{{recording}}/{{object}}/{{view}}_{{kind}}'",
        root.string(), varied.size()));
  }
  const bool first = count(varied[0]) > count(varied[1]);
  found.object = first ? varied[0] : varied[1];
  found.recording = first ? varied[1] : varied[0];
  return found;
}

/// The words of a file's name that are the object's name again, or the same in all files, say
/// nothing.
void drop_known_words(const std::string& object, Words& words) {
  for (const std::string& word : words_of(object)) {
    if (!words.empty() && lower(words.front()) == lower(word)) words.erase(words.begin());
  }
}

void drop_common_words(std::vector<Words>& names) {
  const auto common = [&](bool front) {
    return std::ranges::all_of(names, [&](const Words& words) {
      if (words.empty()) return false;
      const Words& first = names.front();
      const std::string& word = front ? words.front() : words.back();
      return word == (front ? first.front() : first.back()) && !is_number(word);
    });
  };
  while (common(true)) std::ranges::for_each(names, [](Words& w) { w.erase(w.begin()); });
  while (common(false)) std::ranges::for_each(names, [](Words& words) { words.pop_back(); });
}

void read_by_itself(const fs::path& root, const std::vector<Group>& groups, FoundPictures& found) {
  std::size_t levels = groups.front().folders.size();
  for (const Group& group : groups) levels = std::min(levels, group.folders.size());
  const Levels level = levels_of(root, groups, levels);
  const auto value = [&](const Group& group, int at) {
    return at < 0 ? std::string() : group.folders[static_cast<std::size_t>(at)];
  };
  std::vector<Words> rest;
  for (const Group& group : groups) {
    FoundPicture picture = picture_of(group);
    picture.object = value(group, level.object);
    picture.category = value(group, level.category);
    picture.recording = value(group, level.recording);
    picture.view = lower(value(group, level.view));
    Words words = group.leaf;
    drop_known_words(picture.object, words);
    if (picture.view.empty()) picture.view = take_view(words);
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (!(picture.yaw_deg = angle_in(words[i]))) continue;
      words.erase(words.begin() + static_cast<std::ptrdiff_t>(i));
      break;
    }
    rest.push_back(std::move(words));
    found.pictures.push_back(std::move(picture));
  }
  if (level.object >= 0) drop_common_words(rest);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    FoundPicture& picture = found.pictures[i];
    const bool told = !picture.view.empty() || picture.yaw_deg || picture.pose;
    if (picture.object.empty()) {
      // A number behind the view is a frame's, one before it the instance's.
      if (told && rest[i].size() > 1 && is_number(groups[i].leaf.back())) rest[i].pop_back();
      picture.object = fmt::format("{}", fmt::join(rest[i], "_"));
    } else if (!told) {
      picture.view = fmt::format("{}", fmt::join(rest[i], "_"));
    }
  }
  found.layout =
      fmt::format(
          "{}{}{}{}", level.recording >= 0 && level.recording < level.object ? "{recording}/" : "",
          level.category >= 0 ? "{category}/" : "", level.object >= 0 ? "{object}/" : "{object}_",
          level.recording > level.object ? "{recording}/" : "") +
      "{view}_{kind}";
}

/// "mug_2" is the second of its category, "drill" the first, "coke_5449000000996" of its own.
void name_object(FoundPicture& picture) {
  constexpr std::size_t kMostDigits = 9;
  Words words = words_of(picture.object);
  std::string number = "1";
  if (!words.empty()) {
    std::string& last = words.back();
    const auto digits = last.find_last_not_of("0123456789");
    const std::size_t start = digits == std::string::npos ? 0 : digits + 1;
    const std::size_t count = last.size() - start;
    if (count > 0 && count <= kMostDigits && (start > 0 || words.size() > 1)) {
      number = last.substr(start);
      last.resize(start);
      std::erase(words, "");
    }
  }
  const std::string stem = fmt::format("{}", fmt::join(words, "_"));
  if (picture.category.empty()) picture.category = stem;
  picture.category = fmt::format("{}", fmt::join(words_of(picture.category), "_"));
  const bool named_after = (stem + "_").starts_with(picture.category + "_");
  picture.object =
      named_after ? stem + "_" + number : fmt::format("{}_{}_{}", picture.category, stem, number);
}

/// @throws InputError naming pictures of two objects that would get one name.
void name_objects(std::vector<FoundPicture>& pictures) {
  std::map<std::string, std::pair<std::string, fs::path>> sources;
  for (FoundPicture& picture : pictures) {
    const std::string source = (fs::path(picture.category) / picture.object).string();
    name_object(picture);
    const auto& [first, colour] =
        sources.try_emplace(picture.object, source, picture.colour).first->second;
    if (first == source) continue;
    throw InputError(fmt::format(
        "{} is of the object '{}', {} of '{}', and both would be called '{}'; rename one of them",
        colour.string(), first, picture.colour.string(), source, picture.object));
  }
}

}  // namespace

FoundPictures find_pictures(const fs::path& root, const std::string& layout) {
  FoundPictures found;
  const std::vector<Group> groups = picture_files_below(root, found.left_out);
  if (layout.empty()) {
    read_by_itself(root, groups, found);
  } else {
    read_by_pattern(LayoutPattern(layout), groups, found);
    found.layout = layout;
  }
  name_objects(found.pictures);
  const bool nameless =
      std::ranges::any_of(found.pictures, [](const FoundPicture& p) { return p.category.empty(); });
  if (found.pictures.empty() || nameless) {
    throw InputError(fmt::format(
        "{}: it is not clear which part of the paths is the object; say so with --layout, such as "
        "'{{object}}/{{view}}_{{kind}}'",
        root.string()));
  }
  return found;
}

}  // namespace vantage
