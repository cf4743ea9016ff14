/// What values an options struct takes, as a tree: from the same fields() that read and write it.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/core/schema.hpp"

namespace vantage {

/// What may stand at a key, or under the name of a strategy.
struct ValueShape {
  enum class Kind { boolean, whole, natural, number, text, list, section, strategy };

  Kind kind = Kind::section;
  bool nullable = false;
  Range range = {};                           ///< of numbers
  std::size_t size = 0;                       ///< of a list; 0: any
  std::vector<ValueShape> item = {};          ///< of a list: one
  std::vector<ValueShape> keys = {};          ///< of a section
  std::vector<ValueShape> alternatives = {};  ///< of a strategy: sections, by name
  std::string name = {};                      ///< empty: of a whole file, or an item
  std::string text = {};                      ///< of the key; of an alternative its summary
  ConfigNode default_value = {};              ///< null where there is none
};

/// Visitor that lists the keys of a struct.
class ShapeVisitor {
 public:
  /// @param keys outlives this
  explicit ShapeVisitor(std::vector<ValueShape>& keys) : keys_(keys) {}

  template <class T>
  void operator()(std::string_view key, T& value, std::string_view text, const Range& range = {}) {
    const std::string unit = unit_in_name(key);
    ValueShape& shape = keys_.emplace_back(shape_of(value, range));
    shape.name = key;
    shape.text = unit.empty() ? std::string(text) : fmt::format("{} ({})", text, unit);
    if constexpr (!HasFields<T>) shape.default_value = write_node(value);
  }

  template <class T>
  static ValueShape shape_of(T& value, const Range& range) {
    using Kind = ValueShape::Kind;
    if constexpr (HasFields<T>) {
      ValueShape shape{.nullable = true};
      value.fields(ShapeVisitor(shape.keys));
      return shape;
    } else if constexpr (detail::IsVariant<T>::value) {
      return shape_of_strategy(value);
    } else if constexpr (detail::IsVector<T>::value) {
      typename T::value_type item{};
      return {.kind = Kind::list, .item = {shape_of(item, range)}};
    } else if constexpr (detail::IsArray<T>::value) {
      typename T::value_type item{};
      return {.kind = Kind::list, .size = std::tuple_size_v<T>, .item = {shape_of(item, range)}};
    } else if constexpr (detail::IsOptional<T>::value) {
      typename T::value_type inner{};
      ValueShape shape = shape_of(inner, range);
      shape.nullable = true;
      return shape;
    } else if constexpr (std::is_same_v<T, bool>) {
      return {.kind = Kind::boolean};
    } else if constexpr (std::is_arithmetic_v<T>) {
      return {.kind = std::is_floating_point_v<T> ? Kind::number
                      : std::is_unsigned_v<T>     ? Kind::natural
                                                  : Kind::whole,
              .range = range};
    } else {
      return {.kind = Kind::text};
    }
  }

 private:
  /// The alternative at hand with its values, the others with their defaults.
  template <class Variant>
  static ValueShape shape_of_strategy(const Variant& chosen) {
    ValueShape shape{.kind = ValueShape::Kind::strategy};
    for (const std::string_view name : strategy_names<Variant>()) {
      Variant made = name == strategy_name_of(chosen) ? chosen : make_strategy<Variant>(name);
      std::visit(
          [&]<class S>(S& strategy) {
            ValueShape section{.name = std::string(name), .text = std::string(S::text.summary)};
            strategy.fields(ShapeVisitor(section.keys));
            shape.alternatives.push_back(std::move(section));
          },
          made);
    }
    return shape;
  }

  std::vector<ValueShape>& keys_;
};

template <HasFields T>
ValueShape shape_of(T options) {
  return ShapeVisitor::shape_of(options, {});
}

/// Of every alternative of a variant, where their keys stand beside the one that names it.
template <class Variant>
ValueShape shape_of_family() {
  Variant first;
  return ShapeVisitor::shape_of(first, {});
}

}  // namespace vantage
