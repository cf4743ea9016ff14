/// Training statistics in 16 bits a number.
#pragma once

#include <string>

#include "vantage/belief/observation/gaussian_statistics.hpp"
#include "vantage/core/bytes.hpp"

namespace vantage {

/// Appends counts, then for each dimension the range of the means and of the root of the squared
/// deviations, then for each state both in 65 535 equal steps of those ranges. A mean is within
/// 2^-17 of the range that tells states apart; a half-precision float is within 2^-12 of the value,
/// however much of it all states have in common.
/// @param statistics finite
void put_packed(std::string& bytes, const GaussianStatistics& statistics);

/// @throws InputError if the bytes are no statistics of so many states.
GaussianStatistics take_packed(ByteReader& reader, int states);

}  // namespace vantage
