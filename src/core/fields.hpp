/// Options structs <-> configuration. A struct lists its fields once,
///
///   double radius_m = 0.3;
///   void fields(auto&& f) { f("radius_m", radius_m, "of the footprint", above(0.0)); }
///
/// and is then read strictly (unknown key, wrong type, out of range: an error with file, line, key
/// and value), written back with its defaults, checked when it was filled in from C++, and
/// described to users (schema.hpp). The text says what the field is and what raising it does; its
/// unit is the end of its name.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "vantage/core/config_node.hpp"
#include "vantage/core/error.hpp"
#include "vantage/core/strategy.hpp"

namespace vantage {

/// What a number may be. NaN and infinities are never accepted.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_excluded = false;
};
constexpr Range at_least(double min) { return {.min = min}; }
constexpr Range above(double min) { return {.min = min, .min_excluded = true}; }
constexpr Range between(double min, double max) { return {.min = min, .max = max}; }
/// "[0, 1]", "> 0"; empty if any finite number will do.
std::string range_text(const Range& range);

namespace detail {
struct ProbeVisitor {
  template <class T>
  void operator()(std::string_view, T&, std::string_view, const Range& = {}) {}
};
template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};
template <class T>
struct IsArray : std::false_type {};
template <class T, std::size_t N>
struct IsArray<std::array<T, N>> : std::true_type {};
template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <class T>
struct IsVariant : std::false_type {};
template <class... T>
struct IsVariant<std::variant<T...>> : std::true_type {};

void read_value(const ConfigNode& node, double& target);
void read_value(const ConfigNode& node, int& target);
void read_value(const ConfigNode& node, std::uint64_t& target);
void read_value(const ConfigNode& node, bool& target);
void read_value(const ConfigNode& node, std::string& target);
ConfigNode write_value(double value);
ConfigNode write_value(int value);
ConfigNode write_value(std::uint64_t value);
ConfigNode write_value(bool value);
ConfigNode write_value(const std::string& value);

void require_range(const std::string& where, double value, const Range& range);
void require_kind(const ConfigNode& node, ConfigNode::Kind kind);
void require_size(const ConfigNode& node, std::size_t size);
/// `owners(key)`: the strategies of the same family that do have the key.
using KeyOwners = std::vector<std::string_view> (*)(std::string_view key);
void reject_unknown(const ConfigNode& node, const std::vector<std::string_view>& known,
                    KeyOwners owners);
/// The strategy's name in `gain: adaptive` or `gain: {name: adaptive, ...}`.
std::string strategy_name(const ConfigNode& node);

/// Where to look for what a check() of several keys found: the overrides that it names, or `node`.
std::string place_of(const ConfigNode& node, std::string_view message);

template <class T>
void run_check(const ConfigNode& node, T& options) {
  if constexpr (requires { options.check(); }) {
    try {
      options.check();
    } catch (const ConfigError& error) {
      throw ConfigError(place_of(node, error.what()) + error.what());
    }
  }
}

/// The struct's own check(), if it has one, with `where` in front of what it says.
template <class T>
void run_check(const std::string& where, T& options) {
  if constexpr (requires { options.check(); }) {
    try {
      options.check();
    } catch (const ConfigError& error) {
      throw ConfigError(where.empty() ? std::string(error.what()) : where + ": " + error.what());
    }
  }
}
}  // namespace detail

template <class T>
concept HasFields = requires(T value) {
  value.fields(detail::ProbeVisitor{});
};

template <class T>
void read_into(const ConfigNode& node, T& target, const Range& range = {});
template <class T>
ConfigNode write_node(const T& value);

/// Visitor that fills a struct from a map, remembers which keys it knows and collects every
/// problem.
class FieldReader {
 public:
  explicit FieldReader(const ConfigNode& node) : node_(node) {}
  template <class T>
  void operator()(std::string_view key, T& target, std::string_view /*text*/,
                  const Range& range = {}) {
    known_.push_back(key);
    const ConfigNode* child = node_.find(key);
    if (child == nullptr) return;
    attempt([&] { read_into(*child, target, range); });
  }
  void allow(std::string_view key) { known_.push_back(key); }
  void set_owners(detail::KeyOwners owners) { owners_ = owners; }
  /// @throws ConfigError with all problems found, unknown keys included.
  void finish() {
    attempt([&] { detail::reject_unknown(node_, known_, owners_); });
    if (!problems_.empty()) throw ConfigError(problems_);
  }

 private:
  void attempt(auto&& read) {
    try {
      read();
    } catch (const ConfigError& error) {
      problems_.insert(problems_.end(), error.problems().begin(), error.problems().end());
    }
  }
  const ConfigNode& node_;
  std::vector<std::string_view> known_;
  detail::KeyOwners owners_ = nullptr;
  std::vector<std::string> problems_;
};

namespace detail {
struct KeyFinder {
  std::string_view wanted;
  bool& found;
  template <class T>
  void operator()(std::string_view key, T&, std::string_view, const Range& = {}) {
    found = found || key == wanted;
  }
};

template <class Variant>
std::vector<std::string_view> owners_of(std::string_view key) {
  std::vector<std::string_view> names;
  for (const std::string_view name : strategy_names<Variant>()) {
    bool found = false;
    Variant made = make_strategy<Variant>(name);
    std::visit([&](auto& strategy) { strategy.fields(KeyFinder{key, found}); }, made);
    if (found) names.push_back(name);
  }
  return names;
}
}  // namespace detail

/// Visitor that writes a struct, defaults included.
class FieldWriter {
 public:
  explicit FieldWriter(ConfigNode& node) : node_(node) {}
  template <class T>
  void operator()(std::string_view key, T& value, std::string_view, const Range& = {}) {
    node_.set(std::string(key), write_node(value));
  }

 private:
  ConfigNode& node_;
};

/// Visitor that checks the ranges of a struct that was filled in from C++.
class RangeChecker {
 public:
  explicit RangeChecker(std::string prefix) : prefix_(std::move(prefix)) {}
  template <class T>
  void operator()(std::string_view key, T& value, std::string_view /*text*/,
                  const Range& range = {}) {
    const std::string where = prefix_.empty() ? std::string(key) : prefix_ + "." + std::string(key);
    check_value(where, value, range);
  }

 private:
  template <class T>
  void check_value(const std::string& where, T& value, const Range& range) {
    if constexpr (HasFields<T>) {
      value.fields(RangeChecker(where));
      detail::run_check(where, value);
    } else if constexpr (detail::IsVariant<T>::value) {
      std::visit([&](auto& strategy) { check_value(where, strategy, range); }, value);
    } else if constexpr (detail::IsVector<T>::value || detail::IsArray<T>::value) {
      for (auto& item : value) check_value(where, item, range);
    } else if constexpr (detail::IsOptional<T>::value) {
      if (value) check_value(where, *value, range);
    } else if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      detail::require_range(where, static_cast<double>(value), range);
    }
  }
  std::string prefix_;
};

/// @throws ConfigError naming the first field of `options` outside its range, or what its own
/// check() throws. Call it where a library user's options come in.
template <HasFields T>
void check_options(T options, const std::string& name = {}) {
  options.fields(RangeChecker(name));
  detail::run_check(name, options);
}

template <class T>
void read_into(const ConfigNode& node, T& target, const Range& range) {
  if constexpr (HasFields<T>) {
    if (node.kind == ConfigNode::Kind::null) return;
    detail::require_kind(node, ConfigNode::Kind::map);
    FieldReader reader(node);
    target.fields(reader);
    reader.finish();
    detail::run_check(node, target);
  } else if constexpr (detail::IsVariant<T>::value) {
    const std::string name = detail::strategy_name(node);
    try {
      target = make_strategy<T>(name);
    } catch (const ConfigError& error) {
      throw ConfigError(node.where() + ": " + error.what());
    }
    if (node.kind == ConfigNode::Kind::scalar) return;
    std::visit(
        [&](auto& strategy) {
          FieldReader reader(node);
          reader.allow("name");
          reader.set_owners(detail::owners_of<T>);
          strategy.fields(reader);
          reader.finish();
          detail::run_check(node, strategy);
        },
        target);
  } else if constexpr (detail::IsVector<T>::value) {
    detail::require_kind(node, ConfigNode::Kind::list);
    target.assign(node.items.size(), typename T::value_type{});
    for (std::size_t i = 0; i < target.size(); ++i) read_into(node.items[i], target[i], range);
  } else if constexpr (detail::IsArray<T>::value) {
    detail::require_size(node, target.size());
    for (std::size_t i = 0; i < target.size(); ++i) read_into(node.items[i], target[i], range);
  } else if constexpr (detail::IsOptional<T>::value) {
    if (node.kind == ConfigNode::Kind::null) {
      target.reset();
    } else {
      read_into(node, target.emplace(), range);
    }
  } else {
    detail::read_value(node, target);
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      detail::require_range(node.where(), static_cast<double>(target), range);
    }
  }
}

template <class T>
ConfigNode write_node(const T& value) {
  if constexpr (HasFields<T>) {
    ConfigNode node = ConfigNode::make_map();
    T copy = value;
    copy.fields(FieldWriter(node));
    return node;
  } else if constexpr (detail::IsVariant<T>::value) {
    ConfigNode node = ConfigNode::make_map();
    node.set("name", detail::write_value(std::string(strategy_name_of(value))));
    std::visit([&](auto copy) { copy.fields(FieldWriter(node)); }, value);
    return node;
  } else if constexpr (detail::IsVector<T>::value || detail::IsArray<T>::value) {
    ConfigNode node = ConfigNode::make_list();
    for (const auto& item : value) node.items.push_back(write_node(item));
    return node;
  } else if constexpr (detail::IsOptional<T>::value) {
    return value ? write_node(*value) : ConfigNode{};
  } else {
    return detail::write_value(value);
  }
}

}  // namespace vantage
