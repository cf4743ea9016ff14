/// Two levels of a study held against each other, episode by episode.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vantage/study/tables/comparison.hpp"

namespace vantage::bench {

/// Below which p a difference is held for one.
inline constexpr double kSignificant = 0.05;

/// Beyond the interval and with p below kSignificant.
bool is_below(const Difference& difference);
bool is_above(const Difference& difference);

/// What a level came to in one panel.
struct LevelSamples {
  std::string level;
  std::vector<Sample> samples;
};
/// Of the second to the first, of the same episodes but for the level; none without pairs.
std::optional<Difference> paired_difference(const std::string& table, const std::string& panel,
                                            const LevelSamples& reference, const LevelSamples& own);

}  // namespace vantage::bench
