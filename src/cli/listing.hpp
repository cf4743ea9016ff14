/// `vantage list`: what there is to choose from.
#pragma once

#include <string>
#include <string_view>

namespace vantage {

std::string listing_topics_text();  ///< "gains, choices, features, ..."
/// One topic, an entry a line that begins with its name; empty: all topics with headings. @throws
/// ConfigError for another topic.
std::string listing(std::string_view topic);

}  // namespace vantage
