#include "vantage/core/rounding.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace vantage {
namespace {

RC_GTEST_PROP(Rounding, IsThatOfTheStandardLibrary, (int whole, int parts)) {
  const double x = std::ldexp(static_cast<double>(whole), -1) + std::ldexp(parts % 1024, -11);
  RC_ASSERT(floor_int(x) == static_cast<int>(std::floor(x)));
  RC_ASSERT(ceil_int(x) == static_cast<int>(std::ceil(x)));
}

TEST(Rounding, OfWholeNumbersIsThemselves) {
  for (const double x : {-2147483647.0, -1.0, -0.0, 0.0, 7.0, 2147483646.0}) {
    EXPECT_EQ(floor_int(x), static_cast<int>(x));
    EXPECT_EQ(ceil_int(x), static_cast<int>(x));
  }
}

}  // namespace
}  // namespace vantage
