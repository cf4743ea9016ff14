#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "vantage/cli/reference/entry.hpp"
#include "vantage/dataset/dataset_options.hpp"
#include "vantage/recipe/model_recipe.hpp"
#include "vantage/recognition/training.hpp"
#include "vantage/sim/robots/robot_description.hpp"
#include "vantage/study/recognition/recognition_study.hpp"
#include "vantage/study/study.hpp"
#include "vantage/tasks/episode.hpp"

namespace vantage {
namespace {

/// A key of one task, or of several that have it alike.
struct EpisodeKey {
  KeyDescription key;
  std::vector<std::string_view> tasks;
};

std::vector<EpisodeKey> keys_of_tasks() {
  std::vector<EpisodeKey> found;
  for_each_task([&]<class T>(const T& task) {
    for (KeyDescription& key : describe_episode(task)) {
      const auto same =
          std::ranges::find_if(found, [&](const EpisodeKey& other) { return other.key == key; });
      if (same == found.end()) {
        found.push_back({std::move(key), {T::name}});
      } else {
        same->tasks.push_back(T::name);
      }
    }
  });
  return found;
}

std::vector<ReferenceEntry> episode_entries() {
  std::vector<ReferenceEntry> entries;
  for (const auto& [key, tasks] : keys_of_tasks()) {
    entries.push_back(entries_of({key}, "episode").front());
    if (tasks.size() == std::variant_size_v<Task>) continue;
    auto& applies = entries.back().applies;
    applies.insert(applies.begin(), fmt::format("task: {}", fmt::join(tasks, " or ")));
  }
  return entries;
}

std::vector<ReferenceEntry> robot_entries() {
  std::vector<KeyDescription> keys{
      {.key = "kind",
       .type = detail::choice_type(strategy_names<RobotKind>()),
       .text = "what the robot is, which decides what other keys there are"},
      {.key = "model", .type = "text", .text = "MJCF file of the robot, beside robot.yaml"},
      {.key = "episode_defaults",
       .type = "section",
       .text = "task: keys as an episode of that task has them, which hold where an episode with "
               "this robot says nothing of them",
       .section = true}};
  for (const std::string_view name : strategy_names<RobotKind>()) {
    std::visit(
        [&](auto description) {
          description.fields(FieldDescriber(keys, {}, {{"kind", std::string(name)}}));
        },
        make_strategy<RobotKind>(name));
  }
  return entries_of(keys, "robot.yaml");
}

/// Keys below its sections are those of `dataset render` and `train`.
std::vector<ReferenceEntry> recipe_entries() {
  std::vector<KeyDescription> keys = describe_fields(ModelRecipe{});
  std::erase_if(keys, [](const KeyDescription& key) { return key.key.find('.') != key.key.npos; });
  return entries_of(keys, "recipe");
}

}  // namespace

std::vector<ReferenceEntry> key_entries() {
  std::vector<ReferenceEntry> entries = episode_entries();
  const auto add = [&](std::vector<ReferenceEntry> more) {
    for (ReferenceEntry& entry : more) entries.push_back(std::move(entry));
  };
  add(entries_of(study_keys(), "study"));
  add(robot_entries());
  add(entries_of(describe_fields(DatasetOptions{}), "dataset render"));
  add(entries_of(describe_fields(TrainingOptions{}), "train"));
  add(recipe_entries());
  add(entries_of(describe_fields(RecognitionStudyOptions{}), "evaluate"));
  return entries;
}

}  // namespace vantage
