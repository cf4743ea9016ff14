/// Rounding to int in a few instructions: std::floor is a call where SSE4.1 cannot be relied on.
#pragma once

namespace vantage {

/// For |x| < 2^31.
constexpr int floor_int(double x) {
  const int truncated = static_cast<int>(x);
  return truncated - (x < static_cast<double>(truncated) ? 1 : 0);
}
constexpr int ceil_int(double x) {
  const int truncated = static_cast<int>(x);
  return truncated + (x > static_cast<double>(truncated) ? 1 : 0);
}

}  // namespace vantage
