#include "vantage/dataset/pictures/import_directions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "vantage/core/error.hpp"
#include "vantage/dataset/pictures/pose_file.hpp"
#include "vantage/dataset/pictures/view_directions.hpp"

namespace vantage {
namespace {

using Item = ImportedPicture;

bool all_numbers(const std::vector<std::string>& names) {
  return std::ranges::all_of(names, [](const std::string& name) {
    return !name.empty() &&
           std::ranges::all_of(name, [](unsigned char c) { return std::isdigit(c) != 0; });
  });
}

/// Sorts numbers of any length by their value, then by how they are written.
auto by_value(const std::string& digits) {
  const std::size_t zeros = std::min(digits.find_first_not_of('0'), digits.size());
  return std::tuple(digits.size() - zeros, digits.substr(zeros), digits);
}

Directions even_turn(std::vector<std::string> names) {
  std::ranges::sort(names, {}, by_value);
  Directions directions;
  for (std::size_t i = 0; i < names.size(); ++i) {
    directions.yaw_deg[names[i]] =
        360.0 * static_cast<double>(i) / static_cast<double>(names.size());
  }
  return directions;
}

/// Of views of which some have a given angle, the others the usual one of their name.
Directions given_directions(const std::map<std::string, double>& given,
                            const std::vector<std::string>& views) {
  Directions directions;
  std::vector<std::string> without;
  for (const std::string& view : views) {
    const auto yaw_deg = given.find(view);
    const auto named = named_direction(view);
    if (yaw_deg != given.end()) {
      directions.yaw_deg[view] = yaw_deg->second;
    } else if (named && named->yaw_deg) {
      directions.yaw_deg[view] = *named->yaw_deg;
    } else {
      without.push_back(view);
    }
  }
  if (!without.empty()) {
    throw ConfigError(
        fmt::format("--view-yaw: gives angles to some views and none to '{}'; give all of them one",
                    fmt::join(without, "', '")));
  }
  std::vector<double> yaws;
  for (const auto& [view, yaw_deg] : directions.yaw_deg) yaws.push_back(yaw_deg);
  directions.bins = bins_for(yaws);
  directions.names.resize(static_cast<std::size_t>(directions.bins));
  for (const auto& [view, yaw_deg] : directions.yaw_deg) {
    directions.names[static_cast<std::size_t>(yaw_bin(yaw_deg * kDegree, directions.bins))] = view;
  }
  return directions;
}

/// Directions of views that are told by name.
Directions named_directions(const ImportOptions& options, const std::vector<Item>& items,
                            ImportOutcome& outcome) {
  constexpr std::size_t kManyNumbers = 13;
  std::set<std::string> names;
  for (const Item& item : items) {
    if (!item.picture.yaw_deg) names.insert(item.picture.view);
  }
  outcome.views.assign(names.begin(), names.end());
  const bool given = std::ranges::any_of(
      outcome.views, [&](const std::string& name) { return options.yaw_deg.contains(name); });
  if (given) return given_directions(options.yaw_deg, outcome.views);
  if (outcome.views.size() >= kManyNumbers && all_numbers(outcome.views)) {
    outcome.notices.push_back(fmt::format(
        "{} views by number and no angle: taken for one turn in even steps; poses, --view-yaw or "
        "{{yaw}} in --layout tell otherwise",
        outcome.views.size()));
    return even_turn(outcome.views);
  }
  return directions_of_names(outcome.views);
}

/// Of --view-yaw, each of which some picture needs. @throws ConfigError
void check_given_yaws(const ImportOptions& options, const std::vector<Item>& items) {
  for (const auto& [name, yaw_deg] : options.yaw_deg) {
    const auto is_called = [&called = name](const Item& i) { return i.picture.view == called; };
    const bool used = std::ranges::any_of(items, is_called);
    if (!used)
      throw ConfigError(fmt::format("--view-yaw {}={}: no picture is called that", name, yaw_deg));
    const bool asked_for = std::ranges::any_of(
        items, [&](const Item& i) { return is_called(i) && !i.picture.yaw_deg; });
    if (!asked_for) {
      throw ConfigError(fmt::format(
          "--view-yaw {}={}: all pictures of that name tell their angle, by a pose or their name",
          name, yaw_deg));
    }
    if (!std::isfinite(yaw_deg))
      throw ConfigError(fmt::format("--view-yaw {}={}: is no angle", name, yaw_deg));
  }
}

}  // namespace

void read_poses(std::vector<Item>& items) {
  for (Item& item : items) {
    if (item.picture.elevation_deg) item.elevation_deg = item.picture.elevation_deg;
    if (const auto named = named_direction(item.picture.view); named && named->elevation_deg) {
      item.elevation_deg = named->elevation_deg;
    }
    if (!item.picture.pose) continue;
    const PicturePose pose = read_picture_pose(*item.picture.pose);
    item.picture.yaw_deg = pose.yaw_deg;
    if (pose.elevation_deg) item.elevation_deg = pose.elevation_deg;
  }
}

void direct_views(const ImportOptions& options, std::vector<Item>& items, ImportOutcome& outcome) {
  check_given_yaws(options, items);
  const Directions directions = named_directions(options, items, outcome);
  std::vector<double> yaws;
  bool measured = false;
  for (Item& item : items) {
    measured = measured || item.picture.yaw_deg.has_value();
    const double yaw_deg =
        item.picture.yaw_deg ? *item.picture.yaw_deg : directions.yaw_deg.at(item.picture.view);
    item.entry.yaw_rad = yaw_deg * kDegree;
    yaws.push_back(yaw_deg);
  }
  if (measured && !directions.degrees && !outcome.views.empty()) {
    throw InputError(fmt::format(
        "some pictures have an angle and others a view without one, such as '{}'; give all of them "
        "one with --view-yaw NAME=DEG",
        outcome.views.back()));
  }
  PictureNotes& notes = outcome.notes;
  notes.degrees = directions.degrees;
  notes.bins = options.bins > 0 ? options.bins : measured ? bins_for(yaws) : directions.bins;
  if (!measured && notes.bins == directions.bins) notes.views = directions.names;
  if (!notes.degrees && options.bins > 0 && options.bins != directions.bins) {
    throw ConfigError(fmt::format("--bins: {} views by name need as many", directions.bins));
  }
  if (!notes.degrees) {
    outcome.notices.push_back(fmt::format(
        "views {} are told by name: from one to the next is a step, not an angle; --view-yaw "
        "NAME=DEG gives angles",
        fmt::join(outcome.views, ", ")));
  }
}

}  // namespace vantage
