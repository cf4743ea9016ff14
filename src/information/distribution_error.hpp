/// What the information measures throw on arguments that are no distributions.
#pragma once

#include <stdexcept>

namespace vantage {

/// The message names the function, the offending entry and its number.
struct DistributionError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

}  // namespace vantage
