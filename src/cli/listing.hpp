/// `vantage list`: what there is to choose from.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace vantage {

std::string listing_topics_text();  ///< "gains, choices, features, ..."
/// One topic, an entry a line that begins with its name; empty: all topics with headings. @throws
/// ConfigError for another topic.
/// @param explained strategies with what they do, their formula and parameters
std::string listing_text(std::string_view topic, bool explained = false);
/// The same as an array of entries for each topic.
nlohmann::ordered_json listing_json(std::string_view topic, bool explained = false);

}  // namespace vantage
