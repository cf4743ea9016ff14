/// JSON schemas of the files that users write: what `vantage schema` prints.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace vantage {

std::string schema_kinds_text();  ///< "episode, study, ..."

/// @param kind of file @throws ConfigError for another kind, naming those that there are
nlohmann::ordered_json file_schema(std::string_view kind);

}  // namespace vantage
