// What an episode's file says, with the text of every key. Apart from reading it: the templates of
// each take long to compile.
#include "vantage/core/yaml.hpp"
#include "vantage/tasks/episode.hpp"

namespace vantage {
namespace {

/// What is left to the scene has no number before there is one.
void call_open_map_auto(std::vector<KeyDescription>& keys) {
  constexpr std::string_view kOrNull = ", or null";
  for (KeyDescription& key : keys) {
    if (!key.key.starts_with("map.") || key.default_value != "null") continue;
    key.default_value = "auto";
    if (key.type.ends_with(kOrNull)) {
      key.type.replace(key.type.size() - kOrNull.size(), kOrNull.size(), ", or auto");
    }
  }
}

}  // namespace

ConfigNode episode_node(const ResolvedEpisode& resolved) {
  ConfigNode node = ConfigNode::make_map();
  node.set("task", detail::write_value(std::string(strategy_name_of(resolved.task))));
  EpisodeOptions options = resolved.setup.options;
  options.fields(FieldWriter(node));
  std::visit([&](auto task) { task.fields(FieldWriter(node)); }, resolved.task);
  return node;
}

std::string episode_yaml(const ResolvedEpisode& resolved) {
  return to_yaml(episode_node(resolved));
}

std::vector<KeyDescription> describe_episode(const Task& task) {
  std::vector<KeyDescription> keys{
      {.key = "task",
       .type = detail::choice_type(strategy_names<Task>()),
       .default_value = std::string(Tabletop::name),
       .text = "what the episode is about, which decides what other keys there are"}};
  EpisodeOptions options;
  options.fields(FieldDescriber(keys));
  std::visit([&](auto made) { made.fields(FieldDescriber(keys)); },
             make_strategy<Task>(strategy_name_of(task)));
  call_open_map_auto(keys);
  return keys;
}

std::string commented_episode_yaml(const ResolvedEpisode& resolved) {
  return commented_yaml(episode_node(resolved), describe_episode(resolved.task));
}

}  // namespace vantage
