#include "bench/claims/race.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <vector>

#include "bench/claims/paired_difference.hpp"

namespace vantage::bench {

bool Race::is_won_by(double limit) const {
  if (arrived == 0 || arrived < other_arrived) return false;
  if (other_arrived == 0) return true;
  return pairs && pairs->ratio && *pairs->ratio <= limit;
}

bool Race::is_ahead() const {
  const bool sooner =
      pairs && pairs->ratio && pairs->ratio_interval->high < 1.0 && pairs->p_value < kSignificant;
  return is_won_by(1.0) && (sooner || arrival_p < kSignificant);
}

std::string Race::text() const {
  const std::string both = pairs && pairs->ratio ? ratio_text(*pairs) : "no pairs";
  if (arrived == episodes && other_arrived == episodes) return both;
  const std::string p = arrived == other_arrived ? "" : fmt::format(", p {:.2g}", arrival_p);
  return fmt::format("{}; {} and {} of {} get there{}", both, arrived, other_arrived, episodes, p);
}

std::string Race::why_lost(double limit) const {
  std::vector<std::string> reasons;
  if (arrived < other_arrived) {
    reasons.push_back(
        fmt::format("it gets there in {} episodes, the other in {}", arrived, other_arrived));
  }
  if (pairs && pairs->ratio && *pairs->ratio <= limit) {
    const double least_p = std::exp2(1.0 - static_cast<double>(pairs->clusters));
    if (least_p >= kSignificant) {
      reasons.push_back(
          fmt::format("{} pairs can have no p below {:.2g}", pairs->clusters, least_p));
    }
  }
  return fmt::format("{}", fmt::join(reasons, "; "));
}

Race race(const StudyTables& study, const std::string& table, const std::string& panel,
          const std::string& level, const std::string& against) {
  const LevelSamples other{against, study.arrivals(table, panel, against)};
  const LevelSamples own{level, study.arrivals(table, panel, level)};
  Race result{own.samples.size(), other.samples.size(), study.planned(panel, level), {}, 1.0};
  if (result.arrived + result.other_arrived == 0) {
    throw NotRun(
        fmt::format("`{}` in {}: neither `{}` nor `{}` gets there", table, panel, level, against));
  }
  if (result.arrived > 0 && result.other_arrived > 0) {
    result.pairs = paired_difference(table, panel, other, own);
  }
  const auto more_often =
      paired_difference(table, panel, {against, study.whether_arrived(table, panel, against)},
                        {level, study.whether_arrived(table, panel, level)});
  if (more_often) result.arrival_p = more_often->p_value;
  return result;
}

}  // namespace vantage::bench
