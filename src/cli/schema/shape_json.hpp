/// JSON schema (draft 7, which editors know) of what options take.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "vantage/cli/schema/value_shape.hpp"

namespace vantage {

/// A text may be any scalar of YAML; a strategy a name, or a map with `name` and its keys.
nlohmann::ordered_json shape_schema(const ValueShape& shape);
/// `properties` of a section: each with its text and default.
nlohmann::ordered_json properties_of(const ValueShape& section);
/// A map of these properties and no other.
nlohmann::ordered_json map_schema(nlohmann::ordered_json properties);

/// What dotted keys below the map `schema` may be set to, as --set and studies have them: from
/// dotted key to {"$ref": ...}, or {"anyOf": [{"$ref": ...}, ...]} where strategies or `schemas`
/// have it otherwise.
/// @param schemas where each is found, as "#/definitions/tabletop", and what it is
nlohmann::ordered_json dotted_properties(
    const std::vector<std::pair<std::string, nlohmann::ordered_json>>& schemas);

}  // namespace vantage
