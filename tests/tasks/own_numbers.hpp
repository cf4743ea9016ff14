/// The numbers of an options struct itself, without those of the options that it holds.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <type_traits>
#include <vector>

#include "tests/support/option_numbers.hpp"

namespace vantage::support {

/// Of those keys; there may be others.
template <HasFields T>
void expect_own_numbers(T options, std::initializer_list<OptionNumber> expected) {
  std::vector<OptionNumber> found;
  NumberCollector collect(found);
  options.fields(
      [&]<class V>(std::string_view key, V& value, std::string_view text, const Range& range = {}) {
        if constexpr (!HasFields<V>) {
          if constexpr (detail::IsOptional<V>::value) {
            if (value) return;
          }
          collect(key, value, text, range);
        }
      });
  for (const OptionNumber& wanted : expected) {
    const auto number = std::ranges::find(found, wanted.key, &OptionNumber::key);
    ASSERT_NE(number, found.end()) << wanted.key;
    expect_same(*number, wanted);
  }
}

}  // namespace vantage::support
