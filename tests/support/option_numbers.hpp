/// What fields() says of the numbers of an options struct: defaults are results of studies, ranges
/// are promises to users, and neither changes by the way.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "vantage/core/fields.hpp"

namespace vantage::support {

/// A number with its default and range; true and false are 1 and 0, null is NaN.
struct OptionNumber {
  std::string key;  ///< dotted; elements of a list are key[0], key[1] ...
  double value = 0.0;
  Range range = {};
};
inline constexpr double kNull = std::numeric_limits<double>::quiet_NaN();

/// Visitor that collects them; strategies and texts are left out.
class NumberCollector {
 public:
  explicit NumberCollector(std::vector<OptionNumber>& found, std::string prefix = {})
      : found_(found), prefix_(std::move(prefix)) {}

  template <class T>
  void operator()(std::string_view key, T& value, std::string_view /*text*/,
                  const Range& range = {}) {
    const std::string path = prefix_ + std::string(key);
    if constexpr (HasFields<T>) {
      value.fields(NumberCollector(found_, path + "."));
    } else if constexpr (std::is_arithmetic_v<T>) {
      found_.push_back({path, static_cast<double>(value), range});
    } else if constexpr (vantage::detail::IsOptional<T>::value) {
      EXPECT_FALSE(value.has_value()) << path;
      found_.push_back({path, kNull, range});
    } else if constexpr (vantage::detail::IsVector<T>::value ||
                         vantage::detail::IsArray<T>::value) {
      if constexpr (std::is_arithmetic_v<typename T::value_type>) {
        for (std::size_t i = 0; i < value.size(); ++i) {
          found_.push_back({path + "[" + std::to_string(i) + "]", value[i], range});
        }
      }
    }
  }

 private:
  std::vector<OptionNumber>& found_;
  std::string prefix_;
};

inline void expect_same(const OptionNumber& found, const OptionNumber& wanted) {
  EXPECT_EQ(found.key, wanted.key);
  if (std::isnan(wanted.value)) {
    EXPECT_TRUE(std::isnan(found.value)) << wanted.key;
  } else {
    EXPECT_DOUBLE_EQ(found.value, wanted.value) << wanted.key;
  }
  EXPECT_EQ(found.range.min, wanted.range.min) << wanted.key;
  EXPECT_EQ(found.range.max, wanted.range.max) << wanted.key;
  EXPECT_EQ(found.range.min_excluded, wanted.range.min_excluded) << wanted.key;
}

template <HasFields T>
void expect_numbers(T options, std::initializer_list<OptionNumber> expected) {
  std::vector<OptionNumber> found;
  options.fields(NumberCollector(found));
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) expect_same(found[i], expected.begin()[i]);
}

}  // namespace vantage::support
