/// Checks of an option's text: what is wrong with it, or nothing.
#pragma once

#include <string>

namespace vantage {

inline std::string not_empty(const std::string& text) { return text.empty() ? "is empty" : ""; }

}  // namespace vantage
