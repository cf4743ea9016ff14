#include "vantage/cli/schema/shape_json.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "vantage/runtime/json.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;
using ShapeKind = ValueShape::Kind;

const char* type_name(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::boolean: return "boolean";
    case ShapeKind::whole:
    case ShapeKind::natural: return "integer";
    case ShapeKind::number: return "number";
    case ShapeKind::list: return "array";
    case ShapeKind::section: return "object";
    case ShapeKind::text:
    case ShapeKind::strategy: break;
  }
  return "string";
}

/// What a number of this kind may be at all.
Range limits(ShapeKind kind) {
  using Int = std::numeric_limits<int>;
  if (kind == ShapeKind::whole) return between(Int::min(), Int::max());
  return kind == ShapeKind::natural ? at_least(0.0) : Range{};
}

void add_range(Json& schema, const ValueShape& shape) {
  const Range widest = limits(shape.kind);
  const double min = std::max(shape.range.min, widest.min);
  const double max = std::min(shape.range.max, widest.max);
  if (std::isfinite(min)) schema[shape.range.min_excluded ? "exclusiveMinimum" : "minimum"] = min;
  if (std::isfinite(max)) schema["maximum"] = max;
}

Json list_schema(const ValueShape& shape) {
  Json schema{{"type", "array"}, {"items", shape_schema(shape.item.front())}};
  if (shape.size > 0) schema["minItems"] = schema["maxItems"] = shape.size;
  return schema;
}

/// `gain: adaptive` or `gain: {name: adaptive, ...}`.
Json strategy_schema(const ValueShape& shape) {
  Json names = Json::array();
  Json maps = Json::array();
  for (const ValueShape& strategy : shape.alternatives) {
    names.push_back(strategy.name);
    Json properties{{"name", {{"const", strategy.name}}}};
    properties.update(properties_of(strategy));
    Json map = map_schema(std::move(properties));
    map["description"] = strategy.text;
    map["required"] = {"name"};
    maps.push_back(std::move(map));
  }
  maps.insert(maps.begin(), Json{{"enum", names}});
  return {{"anyOf", maps}};
}

void allow_null(Json& schema) {
  if (schema.contains("anyOf")) {
    schema["anyOf"].push_back({{"type", "null"}});
  } else if (schema["type"].is_array()) {
    schema["type"].push_back("null");
  } else {
    schema["type"] = {schema["type"], "null"};
  }
}

/// What a schema allows, without what it says of it.
Json bare(const Json& schema) {
  if (!schema.is_structured()) return schema;
  Json left = schema.is_array() ? Json::array() : Json::object();
  for (const auto& [key, child] : schema.items()) {
    if (schema.is_array()) {
      left.push_back(bare(child));
    } else if (!child.is_null() && key != "description" && key != "default") {
      left[key] = key == "properties" ? Json::object() : bare(child);
      if (key != "properties") continue;
      for (const auto& [name, property] : child.items()) left[key][name] = bare(property);
    }
  }
  return left;
}

/// Where values of one dotted key are described.
struct Place {
  std::string pointer;
  Json allowed;
};
using Places = std::vector<std::pair<std::string, std::vector<Place>>>;

void add_place(const std::string& key, const std::string& pointer, const Json& schema,
               Places& places) {
  auto found = std::ranges::find(places, key, &Places::value_type::first);
  if (found == places.end()) found = places.insert(places.end(), {key, {}});
  Json allowed = bare(schema);
  if (std::ranges::find(found->second, allowed, &Place::allowed) != found->second.end()) return;
  found->second.push_back({pointer, std::move(allowed)});
}

void collect(const Json& schema, const std::string& pointer, const std::string& prefix,
             Places& places) {
  if (schema.contains("properties")) {
    for (const auto& [name, child] : schema["properties"].items()) {
      const std::string at = fmt::format("{}/properties/{}", pointer, name);
      add_place(prefix + name, at, child, places);
      collect(child, at, fmt::format("{}{}.", prefix, name), places);
    }
  }
  if (!schema.contains("anyOf")) return;
  for (std::size_t i = 0; i < schema["anyOf"].size(); ++i) {
    collect(schema["anyOf"][i], fmt::format("{}/anyOf/{}", pointer, i), prefix, places);
  }
}

}  // namespace

Json shape_schema(const ValueShape& shape) {
  Json schema;
  if (shape.kind == ShapeKind::section) {
    schema = map_schema(properties_of(shape));
  } else if (shape.kind == ShapeKind::strategy) {
    schema = strategy_schema(shape);
  } else if (shape.kind == ShapeKind::list) {
    schema = list_schema(shape);
  } else if (shape.kind == ShapeKind::text) {
    schema["type"] = {"string", "number", "boolean"};
  } else {
    schema["type"] = type_name(shape.kind);
    add_range(schema, shape);
  }
  if (shape.nullable) allow_null(schema);
  return schema;
}

Json properties_of(const ValueShape& section) {
  Json properties = Json::object();
  for (const ValueShape& key : section.keys) {
    Json schema{{"description", key.text}};
    schema.update(shape_schema(key));
    if (key.default_value.kind != ConfigNode::Kind::null) {
      schema["default"] = config_json(key.default_value);
    }
    properties[key.name] = std::move(schema);
  }
  return properties;
}

Json map_schema(Json properties) {
  return {
      {"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
}

Json dotted_properties(const std::vector<std::pair<std::string, Json>>& schemas) {
  Places places;
  for (const auto& [pointer, schema] : schemas) collect(schema, pointer, "", places);
  Json properties = Json::object();
  for (const auto& [key, found] : places) {
    Json references = Json::array();
    for (const Place& place : found) references.push_back({{"$ref", place.pointer}});
    properties[key] = references.size() == 1 ? references.front() : Json{{"anyOf", references}};
  }
  return properties;
}

}  // namespace vantage
