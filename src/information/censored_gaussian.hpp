/// Gaussians of which a reading tells the value, a bound, or nothing.
#pragma once

#include <cstdint>

namespace vantage {

/// What a number says of the quantity that was to be measured.
enum class Reading : std::uint8_t {
  exact,
  at_least,  ///< a lower bound: what was seen of it is so much
  none,      ///< nothing
};

/// ln P(Z >= z) of a standard normal Z, for any z: far out, where the probability itself is no
/// longer a number, by its continued fraction.  [AbramowitzStegun1964, 26.2.14]
double log_upper_tail(double z);

/// ln of how likely the reading is of N(mean, variance): the density, the mass above it
/// [Tobin1958], or 1.
double log_likelihood(Reading reading, double value, double mean, double variance);

}  // namespace vantage
