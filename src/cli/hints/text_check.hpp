/// Checks of an option's text: what is wrong with it, or nothing.
#pragma once

#include <algorithm>
#include <string>

namespace vantage {

inline std::string not_empty(const std::string& text) { return text.empty() ? "is empty" : ""; }

/// As a seed is.
inline std::string whole_number(const std::string& text) {
  if (text.empty()) return not_empty(text);
  const bool digits = std::ranges::all_of(text, [](char c) { return '0' <= c && c <= '9'; });
  return digits ? "" : "expected a whole number >= 0, got '" + text + "'";
}

}  // namespace vantage
