#include "vantage/cli/schema/file_schemas.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <vector>

#include "vantage/cli/schema/shape_json.hpp"
#include "vantage/cli/schema/study_schema.hpp"
#include "vantage/dataset/dataset_options.hpp"
#include "vantage/geometry/rgbd_camera.hpp"
#include "vantage/recipe/model_recipe.hpp"
#include "vantage/recognition/training.hpp"
#include "vantage/sim/robots/robot_description.hpp"
#include "vantage/study/recognition/recognition_study.hpp"
#include "vantage/tasks/episode.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

/// What stands where the scene decides, beside `map` and below it.
void allow_auto(Json& schema) {
  Json& type = schema["type"];
  if (!type.is_array()) type = Json::array({type});
  if (std::ranges::find(type, Json("string")) == type.end()) type.push_back("string");
  schema["pattern"] = "^auto$";
}

void allow_auto_map(Json& properties) {
  if (!properties.contains("map")) return;
  Json& map = properties["map"];
  allow_auto(map);
  for (auto& [name, key] : map["properties"].items()) allow_auto(key);
}

template <class T>
Json episode_of(const T& task) {
  Json properties{{"task", {{"const", T::name}, {"description", T::text.summary}}}};
  properties.update(properties_of(shape_of(EpisodeOptions{})));
  properties.update(properties_of(shape_of(task)));
  allow_auto_map(properties);
  return map_schema(std::move(properties));
}

/// Of each task, what its episodes are: name of the task and schema.
Json task_schemas() {
  Json schemas = Json::object();
  for_each_task([&](const auto& task) { schemas[std::string(task.name)] = episode_of(task); });
  return schemas;
}

/// An episode that names no task is of the first.
Json episode_schema() {
  const Json tasks = task_schemas();
  Json names = Json::array();
  Json cases = Json::array();
  for (const auto& [name, schema] : tasks.items()) {
    Json named{{"properties", {{"task", {{"const", name}}}}}};
    if (!names.empty()) named["required"] = {"task"};
    cases.push_back({{"if", named}, {"then", {{"$ref", "#/definitions/" + name}}}});
    names.push_back(name);
  }
  return {{"type", "object"},
          {"properties",
           {{"task",
             {{"description", "what the episode is about, which decides what other keys there are"},
              {"enum", names},
              {"default", names.front()}}}}},
          {"allOf", cases},
          {"definitions", tasks}};
}

/// robot.yaml: keys of its kind beside those that every robot has.
Json robot_schema() {
  const Json tasks = task_schemas();
  Json defaults = Json::object();
  for (const auto& [name, schema] : tasks.items()) {
    defaults[name] = {{"$ref", "#/definitions/" + name}};
  }
  Json kinds = Json::array();
  for (const ValueShape& kind : shape_of_family<RobotKind>().alternatives) {
    Json properties{
        {"kind", {{"const", kind.name}, {"description", kind.text}}},
        {"model",
         {{"type", "string"}, {"description", "MJCF file of the robot, beside robot.yaml"}}},
        {"episode_defaults", map_schema(defaults)}};
    properties.update(properties_of(kind));
    Json map = map_schema(std::move(properties));
    map["required"] = {"kind", "model"};
    kinds.push_back(std::move(map));
  }
  return {{"anyOf", kinds}, {"definitions", tasks}};
}

template <class Options>
Json options_schema() {
  return shape_schema(shape_of(Options{}));
}

struct Kind {
  std::string_view name;
  const char* title;
  Json (*make)();
};

const auto kKinds = std::to_array<Kind>({
    {"episode", "Vantage episode", episode_schema},
    {"study", "Vantage study", [] { return study_schema(task_schemas()); }},
    {"robot", "robot.yaml of Vantage", robot_schema},
    {"sensor", "Sensor of vantage score-views", [] { return shape_schema(shape_of(kRgbdCamera)); }},
    {"recipe", "Recipe of a recognition model of Vantage", options_schema<ModelRecipe>},
    {"dataset", "Keys of vantage dataset render", options_schema<DatasetOptions>},
    {"train", "Keys of vantage train", options_schema<TrainingOptions>},
    {"evaluate", "Keys of vantage evaluate", options_schema<RecognitionStudyOptions>},
});

std::vector<std::string_view> kind_names() {
  std::vector<std::string_view> names;
  for (const Kind& kind : kKinds) names.push_back(kind.name);
  return names;
}

}  // namespace

std::string schema_kinds_text() { return fmt::format("{}", fmt::join(kind_names(), ", ")); }

Json file_schema(std::string_view name) {
  const auto* kind = std::ranges::find(kKinds, name, &Kind::name);
  if (kind == kKinds.end()) {
    throw ConfigError("schema: " + unknown_strategy("kind of file", name, kind_names()));
  }
  Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", kind->title}};
  schema.update(kind->make());
  return schema;
}

}  // namespace vantage
