/// The angle of a full turn.
#pragma once

#include <numbers>

namespace vantage {

inline constexpr double kTurn_rad = 2.0 * std::numbers::pi;

}  // namespace vantage
