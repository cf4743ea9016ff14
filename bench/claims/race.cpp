#include "bench/claims/race.hpp"

#include <fmt/format.h>

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
  std::vector<Sample> samples = study.arrivals(table, panel, against);
  const std::vector<Sample> own = study.arrivals(table, panel, level);
  Race result{own.size(), samples.size(), study.planned(panel, level), {}};
  if (own.empty() && samples.empty()) {
    throw NotRun(
        fmt::format("`{}` in {}: neither `{}` nor `{}` gets there", table, panel, level, against));
  }
  if (own.empty() || samples.empty()) return result;
  for (Sample& sample : samples) sample.level = 0;
  for (Sample sample : own) {
    sample.level = 1;
    samples.push_back(sample);
  }
  for (Sample& sample : samples) sample.panel = 0;
  result.pairs =
      compare_levels(table, table, {panel}, {against, level}, 0, samples).rows.back().difference;
  return result;
}

}  // namespace vantage::bench
