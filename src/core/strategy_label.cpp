#include "vantage/core/strategy_label.hpp"

#include <fmt/format.h>

namespace vantage {
namespace {

void add_differences(const std::string& prefix, const ConfigNode& given, const ConfigNode& defaults,
                     std::string& label) {
  for (std::size_t i = 0; i < given.entries.size(); ++i) {
    const auto& [key, value] = given.entries[i];
    const ConfigNode& usual = defaults.entries[i].second;
    add_differences(prefix + key + ".", value, usual, label);
    if (value.scalar != usual.scalar) label += fmt::format(" {}{}={}", prefix, key, value.scalar);
  }
}

}  // namespace

std::string label_of(std::string_view name, const ConfigNode& given, const ConfigNode& defaults) {
  std::string label(name);
  add_differences("", given, defaults, label);
  return label;
}

}  // namespace vantage
