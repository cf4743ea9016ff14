/// Overrides of a test, and of one case of it.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace vantage::support {

/// `more` in place of what `base` says of the same keys.
inline std::vector<std::string> overridden(std::vector<std::string> base,
                                           const std::vector<std::string>& more) {
  const auto key = [](const std::string& assignment) {
    return assignment.substr(0, assignment.find('='));
  };
  std::erase_if(base, [&](const std::string& assignment) {
    return std::ranges::any_of(
        more, [&](const std::string& other) { return key(other) == key(assignment); });
  });
  base.insert(base.end(), more.begin(), more.end());
  return base;
}

}  // namespace vantage::support
