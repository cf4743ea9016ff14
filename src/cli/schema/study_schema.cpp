#include "vantage/cli/schema/study_schema.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <vector>

#include "vantage/cli/schema/shape_json.hpp"
#include "vantage/study/measures.hpp"
#include "vantage/study/study.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

/// Of factors and levels: they become folders and columns.
Json named(Json values, bool any_number = false) {
  Json schema{{"type", "object"},
              {"propertyNames", {{"pattern", "^[A-Za-z0-9_+-][A-Za-z0-9_.+-]*$"}}},
              {"additionalProperties", std::move(values)}};
  if (!any_number) schema["minProperties"] = 1;
  return schema;
}

Json overrides_schema(const Json& tasks) {
  std::vector<std::pair<std::string, Json>> schemas;
  Json names = Json::array();
  for (const auto& [name, schema] : tasks.items()) {
    schemas.emplace_back("#/definitions/" + name, schema);
    names.push_back(name);
  }
  Json schema = map_schema(dotted_properties(schemas));
  schema["properties"]["task"] = {{"enum", names}};
  schema["type"] = {"object", "null"};
  return schema;
}

Json seeds_schema() {
  return {{"anyOf",
           {{{"type", "string"}, {"pattern", "^ *[0-9]+ *\\.\\. *[0-9]+ *$"}},
            {{"type", "array"},
             {"items", {{"type", "integer"}, {"minimum", 0}}},
             {"minItems", 1},
             {"uniqueItems", true}}}}};
}

Json levels_list() {
  Json schema{{"type", "array"}, {"items", {{"type", {"string", "number", "boolean"}}}}};
  schema["minItems"] = 1;
  return schema;
}

Json report_schema() {
  Json schema = shape_schema(shape_of(StudyReport{}));
  Json& properties = schema["properties"];
  properties["curves"]["items"] = {{"enum", curve_names()}};
  properties["tables"]["items"] = {{"enum", scalar_names()}};
  properties["groups"] = {{"type", "object"}, {"additionalProperties", levels_list()}};
  return schema;
}

Json factors_schema() {
  Json factors = named(named({{"$ref", "#/definitions/overrides"}}), true);
  factors["properties"]["seeds"] = seeds_schema();
  factors["type"] = {"object", "null"};
  return factors;
}

/// What study_keys() say of the keys.
void add_texts(Json& schema) {
  for (const KeyDescription& key : study_keys()) {
    if (key.key == "report.groups")
      schema["report"]["properties"]["groups"]["description"] = key.text;
    if (schema.contains(key.key)) schema[key.key]["description"] = key.text;
  }
}

}  // namespace

Json study_schema(const Json& tasks) {
  Json properties{
      {"title", {{"type", {"string", "number", "boolean", "null"}}}},
      {"episode", {{"type", "string"}}},
      {"set", {{"allOf", {{{"$ref", "#/definitions/overrides"}}}}}},
      {"factors", factors_schema()},
      {"seeds", seeds_schema()},
      {"splits", named({{"type", "object"}, {"additionalProperties", levels_list()}})},
      {"split", {{"type", {"string", "number", "boolean"}}}},
      {"draws", {{"type", "string"}}},
      {"report", report_schema()},
  };
  add_texts(properties);
  Json schema = map_schema(std::move(properties));
  schema["required"] = {"episode"};
  schema["anyOf"] = {{{"required", {"factors"}}}, {{"required", {"seeds"}}}};
  schema["definitions"] = tasks;
  schema["definitions"]["overrides"] = overrides_schema(tasks);
  return schema;
}

}  // namespace vantage
