/// Names as users meet them: a strategy in a few words, for tables and figures, and what a
/// mistyped name was likely meant to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

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

/// Letters that are left out, added, changed or swapped with their neighbour between two words:
/// optimal string alignment.
std::size_t letters_off(std::string_view a, std::string_view b);
/// The one of `known` that is nearest by letters_off(); empty if none is near.
std::string_view nearest_word(std::string_view word, const std::vector<std::string_view>& known);
/// "did you mean gain? "; empty if none of `known` is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& known);

}  // namespace vantage
