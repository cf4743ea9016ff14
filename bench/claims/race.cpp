#include "bench/claims/race.hpp"

#include <fmt/format.h>

#include "bench/claims/paired_difference.hpp"

namespace vantage::bench {

bool Race::is_won_by(double limit) const {
  if (arrived == 0 || arrived < other_arrived) return false;
  return !pairs || !pairs->ratio || *pairs->ratio <= limit;
}

std::string Race::text() const {
  const std::string both =
      pairs && pairs->ratio ? fmt::format("{:.2f} [{:.2f}, {:.2f}], {} pairs, p {:.3f}",
                                          *pairs->ratio, pairs->ratio_interval->low,
                                          pairs->ratio_interval->high, pairs->pairs, pairs->p_value)
                            : "no pairs";
  if (arrived == episodes && other_arrived == episodes) return both;
  return fmt::format("{}; {} and {} of {} get there", both, arrived, other_arrived, episodes);
}

Race race(const StudyTables& study, const std::string& table, const std::string& panel,
          const std::string& level, const std::string& against) {
  const LevelSamples other{against, study.arrivals(table, panel, against)};
  const LevelSamples own{level, study.arrivals(table, panel, level)};
  Race result{own.samples.size(), other.samples.size(), study.planned(panel, level), {}};
  if (result.arrived + result.other_arrived == 0) {
    throw NotRun(
        fmt::format("`{}` in {}: neither `{}` nor `{}` gets there", table, panel, level, against));
  }
  if (result.arrived > 0 && result.other_arrived > 0) {
    result.pairs = paired_difference(table, panel, other, own);
  }
  return result;
}

}  // namespace vantage::bench
