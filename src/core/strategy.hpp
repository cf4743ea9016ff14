/// Strategies: options structs with a call operator, closed in a std::variant. Each alternative has
/// `static constexpr std::string_view name` and `static constexpr StrategyText text`; the variant's
/// family is named beside it:
///
///   template <> inline constexpr std::string_view strategy_family<ViewChoice> = "view choice";
///
/// Names, YAML keys, command-line values and error messages all come from there.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "vantage/core/error.hpp"

namespace vantage {

/// What users are told of a strategy.
struct StrategyText {
  std::string_view summary;       ///< a sentence or two: what it does and when to use it
  std::string_view formula = {};  ///< in plain text; empty: none
  std::string_view source = {};   ///< key of docs/references.bib and place in it; empty: ours
};

template <class Variant>
inline constexpr std::string_view strategy_family = "strategy";

template <class Variant>
std::vector<std::string_view> strategy_names() {
  return []<std::size_t... I>(std::index_sequence<I...>) {
    return std::vector<std::string_view>{std::variant_alternative_t<I, Variant>::name...};
  }
  (std::make_index_sequence<std::variant_size_v<Variant>>{});
}

template <class Variant>
std::string_view strategy_name_of(const Variant& strategy) {
  return std::visit([](const auto& s) { return std::remove_cvref_t<decltype(s)>::name; }, strategy);
}

/// "unknown view choice 'gredy'; known: random, greedy, oracle"
std::string unknown_strategy(std::string_view family, std::string_view name,
                             const std::vector<std::string_view>& known);

/// The alternative called `name`, with its defaults.
/// @throws ConfigError listing the known names.
template <class Variant>
Variant make_strategy(std::string_view name) {
  Variant made;
  const bool found = [&]<std::size_t... I>(std::index_sequence<I...>) {
    return ((std::variant_alternative_t<I, Variant>::name == name
                 ? (made = std::variant_alternative_t<I, Variant>{}, true)
                 : false) ||
            ...);
  }
  (std::make_index_sequence<std::variant_size_v<Variant>>{});
  if (!found) {
    throw ConfigError(unknown_strategy(strategy_family<Variant>, name, strategy_names<Variant>()));
  }
  return made;
}

}  // namespace vantage
