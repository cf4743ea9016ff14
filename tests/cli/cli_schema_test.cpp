// `vantage schema`: what the schemas allow and what they refuse, by a checker of their keywords.
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <regex>
#include <utility>

#include "tests/cli/command_line.hpp"

namespace vantage {
namespace {

using nlohmann::json;

bool is_of_type(const json& value, const std::string& type) {
  if (type == "integer") {
    return value.is_number() && std::floor(value.get<double>()) == value.get<double>();
  }
  return type == value.type_name();
}

/// Whether a value is what a schema (JSON schema, draft 7) allows.
class SchemaChecker {
 public:
  explicit SchemaChecker(json schema) : root_(std::move(schema)) {}
  [[nodiscard]] bool allows(const json& value) const { return fits(root_, value); }

 private:
  [[nodiscard]] bool fits(const json& schema, const json& value) const {
    if (schema.is_boolean()) return schema.get<bool>();
    if (schema.contains("$ref")) {
      const std::string place = schema["$ref"].get<std::string>().substr(1);
      return fits(root_.at(json::json_pointer(place)), value);
    }
    return is_chosen(schema, value) && is_combined(schema, value) &&
           (!value.is_number() || is_in_range(schema, value.get<double>())) &&
           (!value.is_string() || is_like(schema, value.get<std::string>())) &&
           (!value.is_array() || is_list(schema, value)) &&
           (!value.is_object() || is_map(schema, value));
  }

  static bool is_chosen(const json& schema, const json& value) {
    if (schema.contains("type")) {
      const json& type = schema["type"];
      const json types = type.is_array() ? type : json::array({type});
      const auto is = [&](const json& t) { return is_of_type(value, t.get<std::string>()); };
      if (std::ranges::none_of(types, is)) return false;
    }
    if (schema.contains("const") && schema["const"] != value) return false;
    if (!schema.contains("enum")) return true;
    return std::ranges::any_of(schema["enum"], [&](const json& one) { return one == value; });
  }

  [[nodiscard]] bool is_combined(const json& schema, const json& value) const {
    const auto does = [&](const json& other) { return fits(other, value); };
    if (schema.contains("anyOf") && std::ranges::none_of(schema["anyOf"], does)) return false;
    if (schema.contains("allOf") && !std::ranges::all_of(schema["allOf"], does)) return false;
    return !schema.contains("if") || !does(schema["if"]) || does(schema["then"]);
  }

  static bool is_in_range(const json& schema, double value) {
    return value >= schema.value("minimum", value) && value <= schema.value("maximum", value) &&
           (!schema.contains("exclusiveMinimum") ||
            value > schema["exclusiveMinimum"].get<double>());
  }

  static bool is_like(const json& schema, const std::string& text) {
    return std::regex_search(text, std::regex(schema.value("pattern", std::string())));
  }

  [[nodiscard]] bool is_list(const json& schema, const json& list) const {
    if (list.size() < schema.value("minItems", std::size_t{0})) return false;
    if (list.size() > schema.value("maxItems", list.size())) return false;
    for (const json& item : list) {
      const auto count =
          std::ranges::count_if(list, [&](const json& other) { return other == item; });
      if (schema.value("uniqueItems", false) && count > 1) return false;
      if (schema.contains("items") && !fits(schema["items"], item)) return false;
    }
    return true;
  }

  [[nodiscard]] bool is_map(const json& schema, const json& map) const {
    if (map.size() < schema.value("minProperties", std::size_t{0})) return false;
    for (const json& key : schema.value("required", json::array())) {
      if (!map.contains(key.get<std::string>())) return false;
    }
    const json known = schema.value("properties", json::object());
    const json names = schema.value("propertyNames", json(true));
    const json others = schema.value("additionalProperties", json(true));
    for (const auto& [key, value] : map.items()) {
      if (!fits(names, json(key))) return false;
      if (!fits(known.contains(key) ? known.at(key) : others, value)) return false;
    }
    return true;
  }

  json root_;
};

class Schemas : public CommandLine {
 protected:
  json schema(const std::string& kind) {
    const Result told = vantage("schema " + kind);
    EXPECT_EQ(told.exit_code, 0) << told.output;
    return json::parse(told.output, nullptr, false);
  }
  void check(const std::string& kind, const std::vector<const char*>& allowed,
             const std::vector<const char*>& refused) {
    const SchemaChecker checker(schema(kind));
    for (const char* good : allowed) EXPECT_TRUE(checker.allows(json::parse(good))) << good;
    for (const char* wrong : refused) EXPECT_FALSE(checker.allows(json::parse(wrong))) << wrong;
  }
};

/// Of every task; with a letter more, none of its keys is known.
TEST_F(Schemas, AConfigurationAsItIsPrintedIsAnEpisode) {
  const SchemaChecker checker(schema("episode"));
  for (const std::string name :
       {"tabletop", "office_small", "recognition", "change_detection", "trajectory"}) {
    const json config =
        json::parse(vantage("run --print-config --json assets/episodes/" + name + ".yaml").output);
    EXPECT_TRUE(checker.allows(config)) << name;
    for (const auto& [key, value] : config.items()) {
      json changed = config;
      changed.erase(key);
      changed[key + "x"] = value;
      EXPECT_FALSE(checker.allows(changed)) << name << ": " << key;
    }
  }
}

TEST_F(Schemas, OfEpisodesAllowWhatARunTakes) {
  check("episode",
        {R"({})", R"({"task": "tabletop", "scans": 3})", R"({"map": "auto"})",
         R"({"map": {"cells": "auto"}})", R"({"map": {"cells": [1, 4096, 2]}})",
         R"({"gain": "simple"})", R"({"gain": {"name": "beer_lambert", "a": 1}})",
         R"({"robot": null})", R"({"threads": 256})", R"({"task": "exploration", "frontiers": {}})",
         R"({"task": "trajectory", "horizon": 5})", R"({"robot": {"start_pose": [0, 0, 1]}})",
         R"({"robot": {"start_pose": null}})"},
        {R"(3)",
         R"({"scns": 3})",
         R"({"scans": "three"})",
         R"({"scans": -1})",
         R"({"scans": 2.5})",
         R"({"scans": null})",
         R"({"gain": "beer_lambrt"})",
         R"({"gain": {"a": 0.9}})",
         R"({"gain": {"name": "beer_lambert", "a": 1.5}})",
         R"({"gain": {"name": "simple", "a": 0.9}})",
         R"({"gain": null})",
         R"({"task": "tabeltop"})",
         R"({"task": "exploration", "candidates": {}})",
         R"({"horizon": 5})",
         R"({"map": "automatic"})",
         R"({"map": {"cells": [1, 2]}})",
         R"({"map": {"cells": [1, 2, 3, 4]}})",
         R"({"map": {"cells": [0, 2, 3]}})",
         R"({"map": {"cells": [1, 2, 4097]}})",
         R"({"robot": {"start_pose": [0, 0]}})",
         R"({"threads": 2.5})",
         R"({"threads": 0})",
         R"({"threads": 257})",
         R"({"task": "trajectory", "scans": 3})"});
}

TEST_F(Schemas, OfStudiesAllowWhatASweepTakes) {
  check("study",
        {R"({"episode": "e.yaml", "seeds": "1..20"})", R"({"episode": "e", "seeds": [3, 1]})",
         R"({"episode": "e", "seeds": " 1 .. 2 ", "title": 7})",
         R"({"episode": "e", "factors": {"method": {"a.b": {"gain": "simple", "gain.a": 0.5}, )"
         R"("b": null}}})",
         R"({"episode": "e", "factors": null, "seeds": [1]})",
         R"({"episode": "e", "factors": {"seeds": [1]}})",
         R"({"episode": "e", "seeds": [1], "set": {"map.cells": [9, 9, 9]}, "split": "a", )"
         R"("splits": {"a": {"m": ["x", 1, true]}}})",
         R"({"episode": "e", "seeds": [1], "report": {"curves": ["share_left"], )"
         R"("tables": ["area"], "groups": {"g": ["x"]}}})",
         R"({"episode": "e", "seeds": [1], "set": {"task": "exploration", )"
         R"("gain": {"name": "simple"}}})",
         R"({"episode": "e", "seeds": [1], "set": null})"},
        {R"({"seeds": [1]})",
         R"({"episode": "e"})",
         R"({"episode": 3, "seeds": [1]})",
         R"({"episode": "e", "seeds": "1-20"})",
         R"({"episode": "e", "seeds": [1, 1]})",
         R"({"episode": "e", "seeds": [-1]})",
         R"({"episode": "e", "seeds": []})",
         R"({"episode": "e", "seeds": [1], "set": {"gian": "simple"}})",
         R"({"episode": "e", "seeds": [1], "set": {"gain.a": 2}})",
         R"({"episode": "e", "seeds": [1], "set": {"task": "flying"}})",
         R"({"episode": "e", "factors": {"a/b": {"a": {}}}})",
         R"({"episode": "e", "factors": {"method": {"a b": {}}}})",
         R"({"episode": "e", "factors": {"method": {".a": {}}}})",
         R"({"episode": "e", "factors": {"method": {}}})",
         R"({"episode": "e", "factors": {"method": {"a": {"gain": "smple"}}}})",
         R"({"episode": "e", "factors": {"seeds": ["x"]}})",
         R"({"episode": "e", "seeds": [1], "report": {"curves": ["area"]}})",
         R"({"episode": "e", "seeds": [1], "report": {"tables": ["share_left"]}})",
         R"({"episode": "e", "seeds": [1], "report": {"groups": {"g": []}}})",
         R"({"episode": "e", "seeds": [1], "report": {"compares": "m"}})",
         R"({"episode": "e", "seeds": [1], "split": []})",
         R"({"episode": "e", "seeds": [1], "splits": {"a": {"m": []}}})",
         R"({"episode": "e", "seeds": [1], "splits": {}})",
         R"({"episode": "e", "seeds": [1], "extra": 1})"});
}

TEST_F(Schemas, OfRobotsAllowTheKeysOfTheirKind) {
  check("robot",
        {R"({"kind": "mobile_base", "model": "a.xml", "base": "b", )"
         R"("drive": {"name": "omnidirectional", "x": "x"}})",
         R"({"kind": "mobile_base", "model": "a.xml", "drive": "differential"})",
         R"({"kind": "mobile_base", "model": "a.xml", "footprint": {"outline_m": [[0, 5], [-5, )"
         R"(1]]}})",
         R"({"kind": "mobile_base", "model": "a.xml", )"
         R"("episode_defaults": {"tabletop": {"scans": 3}, "trajectory": {"horizon": 5}}})"},
        {R"({"model": "a.xml"})", R"({"kind": "mobile_base"})",
         R"({"kind": "submarine", "model": "a.xml"})", R"({"kind": "mobile_base", "model": 3})",
         R"({"kind": "mobile_base", "model": "a.xml", "wings": 2})",
         R"({"kind": "mobile_base", "model": "a.xml", "drive": "walking"})",
         R"({"kind": "mobile_base", "model": "a.xml", "drive": {"x": "x"}})",
         R"({"kind": "mobile_base", "model": "a.xml", "footprint": {"outline_m": [[0, 5, 1]]}})",
         R"({"kind": "mobile_base", "model": "a.xml", "footprint": {"outline_m": [[0, 5.1]]}})",
         R"({"kind": "mobile_base", "model": "a.xml", "episode_defaults": {"flying": {}}})",
         R"({"kind": "mobile_base", "model": "a.xml", )"
         R"("episode_defaults": {"tabletop": {"horizon": 3}}})"});
}

TEST_F(Schemas, OfSensorsAllowWhatViewsAreScoredWith) {
  check("sensor",
        {R"({})", R"(null)",
         R"({"half_width_rad": 3.1416, "tilt_min_rad": -1.5, "range_min_m": 0, "panorama": true})"},
        {R"("auto")", R"({"half_width_rad": 0})", R"({"half_width_rad": 3.15})",
         R"({"tilt_min_rad": -1.51})", R"({"range_min_m": -0.1})", R"({"range_max_m": 0})",
         R"({"panorama": 1})", R"({"range": 3})"});
}

TEST_F(Schemas, OfCommandsAllowTheirKeys) {
  check("dataset",
        {R"({"seed": 1099511627776, "session": 2147483647})", R"({"seed": 0, "session": 1})"},
        {R"({"seed": -1})", R"({"seed": 0.5})", R"({"session": 0})", R"({"session": 2147483648})"});
  check("train",
        {R"({"features": ["colour", {"name": "sift"}], "videos": [1, 4], "costs_s": [0.5]})"},
        {R"({"features": "colour"})", R"({"features": ["colr"]})", R"({"videos": [1, 2.5]})",
         R"({"costs_s": ["long"]})"});
  check("evaluate", {R"({"methods": ["random"], "literal": false, "starts": 1})"},
        {R"({"methods": "random"})", R"({"literal": 1})", R"({"starts": 0})"});
  check("recipe", {R"({"recordings": [{"session": 2}], "render": {"objects": 3}, "train": null})"},
        {R"({"recordings": {"session": 2}})", R"({"recordings": [{"sesion": 2}]})",
         R"({"render": 3})"});
}

TEST_F(Schemas, SayWhatTheyAreOf) {
  const json sensor = schema("sensor");
  EXPECT_EQ(sensor["$schema"], "http://json-schema.org/draft-07/schema#");
  EXPECT_EQ(sensor["title"], "Sensor of vantage score-views");
  EXPECT_EQ(sensor["type"], json::array({"object", "null"}));
  EXPECT_EQ(sensor["additionalProperties"], false);
  const json& width = sensor["properties"]["half_width_rad"];
  EXPECT_EQ(width["description"],
            "half of the horizontal field of view; higher sees more at once (rad)");
  EXPECT_EQ(width["type"], "number");
  EXPECT_EQ(width["exclusiveMinimum"], 0.0);
  EXPECT_EQ(width["maximum"], 3.1416);
  EXPECT_EQ(width["default"], 0.5044);
  EXPECT_FALSE(width.contains("minimum"));
  EXPECT_FALSE(sensor["properties"]["range_max_m"].contains("maximum"));
  EXPECT_EQ(sensor["properties"]["panorama"]["type"], "boolean");
  const json task = schema("episode")["properties"]["task"];
  EXPECT_EQ(task["default"], "tabletop");
  EXPECT_EQ(task["enum"], json::array({"tabletop", "exploration", "recognition", "change_detection",
                                       "trajectory"}));
  const json study = schema("study")["properties"];
  EXPECT_THAT(study["seeds"]["description"].get<std::string>(), HasSubstr("a level for each"));
  EXPECT_THAT(study["report"]["properties"]["groups"]["description"].get<std::string>(),
              HasSubstr("draws of one pair are averaged"));
  EXPECT_EQ(vantage("schema sensor --json").output, vantage("schema sensor").output);
  expect_error(vantage("schema episod"), 2, {"schema: ", "did you mean episode?"});
}

}  // namespace
}  // namespace vantage
