/// Options structs, described to users: every key with type, unit, default, range and text, from
/// the same fields() that read and write it.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/core/fields.hpp"

namespace vantage {

struct KeyDescription {
  std::string key = {};  ///< dotted path; the elements of a list are key[]
  /// Which strategies have it, outermost first: {"gain", "fsmi"} for gain.d_occ.
  struct Owner {
    std::string key;
    std::string strategy;
    bool operator==(const Owner&) const = default;
  };
  std::vector<Owner> owners = {};
  std::string type = {};           ///< "number", "list of 3 numbers", "one of simple, adaptive"
  std::string unit = {};           ///< empty: none
  std::string default_value = {};  ///< as YAML has it; empty for a section
  std::string range = {};          ///< "[0, 1]", "> 0"; empty: any
  std::string text = {};
  bool section = false;  ///< its keys follow
  bool operator==(const KeyDescription&) const = default;
};

/// The unit that the end of a name tells: "m" of radius_m, "m/s" of speed_m_s; empty: none.
std::string unit_in_name(std::string_view name);

/// `text` broken at spaces into lines of at most `width` characters, longer words apart.
std::vector<std::string_view> wrapped(std::string_view text, std::size_t width);

namespace detail {
/// "a, b" with a line each left out: a value as YAML would write it in one line.
std::string value_text(const ConfigNode& node);
std::string list_type(std::string_view element, std::size_t size);
std::string choice_type(const std::vector<std::string_view>& names);

template <class T>
std::string type_text() {
  if constexpr (std::is_same_v<T, bool>) {
    return "true or false";
  } else if constexpr (std::is_integral_v<T>) {
    return "whole number";
  } else if constexpr (std::is_arithmetic_v<T>) {
    return "number";
  } else if constexpr (std::is_same_v<T, std::string>) {
    return "text";
  } else if constexpr (IsVariant<T>::value) {
    return choice_type(strategy_names<T>());
  } else if constexpr (IsVector<T>::value) {
    return list_type(type_text<typename T::value_type>(), 0);
  } else if constexpr (IsArray<T>::value) {
    return list_type(type_text<typename T::value_type>(), std::tuple_size_v<T>);
  } else if constexpr (IsOptional<T>::value) {
    return type_text<typename T::value_type>() + ", or null";
  } else {
    return "section";
  }
}
}  // namespace detail

/// Visitor that describes the fields of a struct, those of strategies that are not chosen included.
class FieldDescriber {
 public:
  /// @param keys outlives this
  explicit FieldDescriber(std::vector<KeyDescription>& keys, std::string prefix = {},
                          std::vector<KeyDescription::Owner> owners = {})
      : keys_(keys), prefix_(std::move(prefix)), owners_(std::move(owners)) {}

  template <class T>
  void operator()(std::string_view key, T& value, std::string_view text, const Range& range = {}) {
    const std::string path = prefix_ + std::string(key);
    KeyDescription description{.key = path,
                               .owners = owners_,
                               .type = detail::type_text<T>(),
                               .unit = unit_in_name(key),
                               .range = range_text(range),
                               .text = std::string(text),
                               .section = HasFields<T>};
    if constexpr (detail::IsVariant<T>::value) {
      description.default_value = std::string(strategy_name_of(value));
    } else if constexpr (!HasFields<T>) {
      description.default_value = detail::value_text(write_node(value));
    }
    keys_.push_back(std::move(description));
    describe_inside(path, value);
  }

 private:
  template <class T>
  void describe_inside(const std::string& path, T& value) {
    if constexpr (HasFields<T>) {
      value.fields(FieldDescriber(keys_, path + ".", owners_));
    } else if constexpr (detail::IsVariant<T>::value) {
      describe_alternatives(path, value);
    } else if constexpr (detail::IsVector<T>::value || detail::IsArray<T>::value) {
      using Element = typename T::value_type;
      if constexpr (HasFields<Element> || detail::IsVariant<Element>::value) {
        Element element{};
        describe_inside(path + "[]", element);
      }
    } else if constexpr (detail::IsOptional<T>::value) {
      typename T::value_type inner{};
      describe_inside(path, inner);
    }
  }

  /// The alternative at hand with its values, the others with their defaults.
  template <class Variant>
  void describe_alternatives(const std::string& path, Variant& chosen) {
    for (const std::string_view name : strategy_names<Variant>()) {
      Variant made = name == strategy_name_of(chosen) ? chosen : make_strategy<Variant>(name);
      auto owners = owners_;
      owners.push_back({path, std::string(name)});
      std::visit(
          [&](auto& strategy) {
            strategy.fields(FieldDescriber(keys_, path + ".", std::move(owners)));
          },
          made);
    }
  }

  std::vector<KeyDescription>& keys_;
  std::string prefix_;
  std::vector<KeyDescription::Owner> owners_;
};

/// Every key of `options`, in the order of fields().
template <HasFields T>
std::vector<KeyDescription> describe_fields(T options) {
  std::vector<KeyDescription> keys;
  options.fields(FieldDescriber(keys));
  return keys;
}

/// `root` as YAML, with what `keys` say of its keys in comments above them.
std::string commented_yaml(const ConfigNode& root, const std::vector<KeyDescription>& keys);

/// What is said of a strategy: its name, and what StrategyText has.
struct StrategyDescription {
  std::string_view family;
  std::string_view name;
  StrategyText text;
  std::vector<KeyDescription> parameters;
};

/// Every alternative of a variant, with its defaults.
template <class Variant>
std::vector<StrategyDescription> describe_strategies() {
  std::vector<StrategyDescription> found;
  for (const std::string_view name : strategy_names<Variant>()) {
    std::visit(
        [&]<class S>(const S& strategy) {
          found.push_back({strategy_family<Variant>, name, S::text, describe_fields(strategy)});
        },
        make_strategy<Variant>(name));
  }
  return found;
}

}  // namespace vantage
