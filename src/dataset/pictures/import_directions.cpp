#include "vantage/dataset/pictures/import_directions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <numbers>
#include <set>
#include <utility>

#include "vantage/core/error.hpp"
#include "vantage/dataset/pictures/pose_file.hpp"
#include "vantage/dataset/pictures/view_directions.hpp"

namespace vantage {
namespace {

using Item = ImportedPicture;
constexpr double kDegree = std::numbers::pi / 180.0;

bool all_numbers(const std::vector<std::string>& names) {
  return std::ranges::all_of(names, [](const std::string& name) {
    return !name.empty() &&
           std::ranges::all_of(name, [](unsigned char c) { return std::isdigit(c) != 0; });
  });
}

Directions even_turn(const std::vector<std::string>& names) {
  std::vector<std::pair<long, std::string>> order;
  for (const std::string& name : names) order.emplace_back(std::stol(name), name);
  std::ranges::sort(order);
  Directions directions;
  for (std::size_t i = 0; i < order.size(); ++i) {
    directions.yaw_deg[order[i].second] =
        360.0 * static_cast<double>(i) / static_cast<double>(order.size());
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
  if (outcome.views.size() >= kManyNumbers && all_numbers(outcome.views)) {
    outcome.notices.push_back(fmt::format(
        "{} views by number and no angle: taken for one turn in even steps; poses or {{yaw}} in "
        "--layout tell otherwise",
        outcome.views.size()));
    return even_turn(outcome.views);
  }
  const bool all_given = std::ranges::all_of(
      outcome.views, [&](const std::string& name) { return options.yaw_deg.contains(name); });
  if (!all_given || outcome.views.empty()) return directions_of_names(outcome.views);
  Directions given;
  std::vector<double> yaws;
  for (const std::string& name : outcome.views) yaws.push_back(options.yaw_deg.at(name));
  given.bins = bins_for(yaws);
  given.names.resize(static_cast<std::size_t>(given.bins));
  for (std::size_t i = 0; i < yaws.size(); ++i) {
    given.yaw_deg[outcome.views[i]] = yaws[i];
    given.names[static_cast<std::size_t>(yaw_bin(yaws[i] * kDegree, given.bins))] =
        outcome.views[i];
  }
  return given;
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
  for (const auto& [name, yaw_deg] : options.yaw_deg) {
    const bool used =
        std::ranges::any_of(items, [&](const Item& i) { return i.picture.view == name; });
    if (!used)
      throw ConfigError(fmt::format("--view-yaw {}={}: no picture is called that", name, yaw_deg));
  }
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
