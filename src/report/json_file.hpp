/// The JSON files of run folders, which anybody may have written.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace vantage {

/// @param Json json or ordered_json
/// @param name of the file, for messages
/// @throws InputError naming it if the text is no JSON, or nested deeper than 64 levels, which no
/// file of ours is and which would end programs that go down level by level.
template <class Json>
Json parsed_json(std::string_view text, const std::string& name);
extern template nlohmann::json parsed_json(std::string_view, const std::string&);
extern template nlohmann::ordered_json parsed_json(std::string_view, const std::string&);

/// The same, but null if it is no JSON object.
template <class Json>
Json json_object_or_null(std::string_view text);
extern template nlohmann::json json_object_or_null(std::string_view);
extern template nlohmann::ordered_json json_object_or_null(std::string_view);

}  // namespace vantage
