#include "vantage/cli/listing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "vantage/cli/reference/entry.hpp"
#include "vantage/cli/reference/feature_listing.hpp"
#include "vantage/core/data_root.hpp"
#include "vantage/models/catalogue/database/object_database.hpp"
#include "vantage/perception/features/feature.hpp"
#include "vantage/planners/choice/view_choice.hpp"
#include "vantage/planners/gain.hpp"
#include "vantage/planners/objects/object_view_choice.hpp"
#include "vantage/planners/trajectory/trajectory_method.hpp"
#include "vantage/tasks/task.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

std::vector<std::string> owned(const std::vector<std::string_view>& names) {
  return {names.begin(), names.end()};
}

std::vector<std::string> sorted_entries(const fs::path& folder, auto&& wanted) {
  std::vector<std::string> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(data_root() / folder, error)) {
    if (wanted(entry)) found.push_back((folder / entry.path().filename()).string());
  }
  std::ranges::sort(found);
  return found;
}

std::vector<std::string> yaml_files(const fs::path& folder) {
  return sorted_entries(
      folder, [](const fs::directory_entry& e) { return e.path().extension() == ".yaml"; });
}

std::vector<std::string> scenes() {
  auto found = sorted_entries("models/scenes", [](const fs::directory_entry& e) {
    return fs::exists(e.path() / "scene.xml");
  });
  for (auto& scene : found) scene += "/scene.xml";
  return found;
}

std::vector<std::string> robots() {
  return sorted_entries("models/robots", [](const fs::directory_entry& e) {
    return fs::exists(e.path() / "robot.yaml");
  });
}

std::vector<std::string> objects() {
  std::vector<std::string> names;
  for (const DatabaseObject& object : object_database()) names.push_back(object.name);
  return names;
}

struct Topic {
  std::string_view name;
  std::vector<std::string> (*entries)();
  std::string_view family = {};  ///< of the strategies that it lists; empty: none
};

constexpr auto kTopics = std::to_array<Topic>({
    {"tasks", [] { return owned(strategy_names<Task>()); }, strategy_family<Task>},
    {"gains", [] { return owned(strategy_names<Gain>()); }, strategy_family<Gain>},
    {"choices", [] { return owned(strategy_names<ViewChoice>()); }, strategy_family<ViewChoice>},
    {"features", feature_lines, strategy_family<Feature>},
    {"object_views", [] { return owned(strategy_names<ObjectViewChoice>()); },
     strategy_family<ObjectViewChoice>},
    {"optimisers", [] { return owned(strategy_names<TrajectoryMethod>()); },
     strategy_family<TrajectoryMethod>},
    {"episodes", [] { return yaml_files("assets/episodes"); }},
    {"studies", [] { return yaml_files("assets/studies"); }},
    {"scenes", scenes},
    {"robots", robots},
    {"objects", objects},
});

/// The one that is wanted, or all. @throws ConfigError if there is none of that name.
std::vector<const Topic*> topics(std::string_view wanted) {
  std::vector<const Topic*> found;
  for (const Topic& topic : kTopics) {
    if (wanted.empty() || topic.name == wanted) found.push_back(&topic);
  }
  if (found.empty()) {
    std::vector<std::string_view> names;
    for (const Topic& topic : kTopics) names.push_back(topic.name);
    throw ConfigError(fmt::format("list: {}", unknown_strategy("topic", wanted, names)));
  }
  return found;
}

std::vector<ReferenceEntry> strategies(std::string_view family) {
  auto all = strategy_entries();
  std::erase_if(all, [&](const ReferenceEntry& entry) { return entry.place != family; });
  return all;
}

}  // namespace

std::string listing_topics_text() {
  std::vector<std::string_view> names;
  for (const Topic& topic : kTopics) names.push_back(topic.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string listing_text(std::string_view wanted, bool explained) {
  std::string text;
  for (const Topic* topic : topics(wanted)) {
    if (wanted.empty()) text += fmt::format("{}:\n", topic->name);
    if (explained && !topic->family.empty()) {
      for (const ReferenceEntry& entry : strategies(topic->family)) text += entry_text(entry);
      continue;
    }
    for (const auto& entry : topic->entries()) {
      text += fmt::format("{}{}\n", wanted.empty() ? "  " : "", entry);
    }
  }
  return text;
}

nlohmann::ordered_json listing_json(std::string_view wanted, bool explained) {
  nlohmann::ordered_json listing;
  for (const Topic* topic : topics(wanted)) {
    nlohmann::ordered_json& entries = listing[std::string(topic->name)];
    if (!explained || topic->family.empty()) {
      entries = topic->entries();
      continue;
    }
    for (const ReferenceEntry& entry : strategies(topic->family)) {
      entries.push_back(entry_json(entry));
    }
  }
  return listing;
}

}  // namespace vantage
