#include "bench/tables/paired_difference.hpp"

namespace vantage::bench {

bool is_below(const Difference& difference) {
  return difference.interval.high < 0.0 && difference.p_value < kSignificant;
}

bool is_above(const Difference& difference) {
  return difference.interval.low > 0.0 && difference.p_value < kSignificant;
}

std::optional<Difference> paired_difference(const std::string& table, const std::string& panel,
                                            const LevelSamples& reference,
                                            const LevelSamples& own) {
  std::vector<Sample> samples;
  for (const LevelSamples* of : {&reference, &own}) {
    for (Sample sample : of->samples) {
      sample.panel = 0;
      sample.level = of == &own ? 1 : 0;
      samples.push_back(sample);
    }
  }
  const Comparison compared =
      compare_levels(table, table, {panel}, {reference.level, own.level}, 0, samples);
  return compared.rows.back().difference;
}

}  // namespace vantage::bench
