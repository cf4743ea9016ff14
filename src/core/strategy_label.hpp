/// A strategy in a few words, for tables and figures.
#pragma once

#include <string>
#include <string_view>

#include "vantage/core/fields.hpp"

namespace vantage {

/// `name`, then " key=value" for every scalar of `given` that `defaults` has otherwise.
std::string label_of(std::string_view name, const ConfigNode& given, const ConfigNode& defaults);

/// "beer_lambert a=0.99": the strategy's name and what is not its default.
template <class Variant>
std::string strategy_label(const Variant& strategy) {
  const auto name = strategy_name_of(strategy);
  const Variant defaults = make_strategy<Variant>(name);
  return label_of(name, write_node(strategy), write_node(defaults));
}

}  // namespace vantage
