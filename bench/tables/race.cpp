#include "bench/tables/race.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <vector>

namespace vantage::bench {
namespace {

/// "p 0.12"; "p 0.25: of 4 pairs it cannot be below 0.12"
std::string why_insignificant(const Difference& pairs) {
  const double least_p = std::exp2(1.0 - static_cast<double>(pairs.clusters));
  const std::string p = fmt::format("p {:.2g}", pairs.p_value);
  if (least_p < kSignificant) return p;
  return fmt::format("{}: of {} pairs it cannot be below {:.2g}", p, pairs.clusters, least_p);
}

}  // namespace

bool Race::is_won_by(double limit) const {
  if (arrived == 0 || arrived < other_arrived) return false;
  if (other_arrived == 0) return true;
  return pairs && pairs->ratio && *pairs->ratio <= limit;
}

bool Race::is_significant() const { return (pairs ? pairs->p_value : arrival_p) < kSignificant; }

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
  if (pairs && pairs->ratio && *pairs->ratio > limit) {
    reasons.push_back(fmt::format("{:.3f} is above {}", *pairs->ratio, limit));
  } else if (pairs && pairs->ratio && pairs->p_value >= kSignificant) {
    reasons.push_back(why_insignificant(*pairs));
  }
  return fmt::format("{}", fmt::join(reasons, "; "));
}

std::string Race::why_not_ahead() const {
  if (is_ahead()) return "";
  if (arrived < other_arrived) {
    return fmt::format("gets there in {} episodes, the other in {}", arrived, other_arrived);
  }
  if (!pairs || !pairs->ratio) return "no pairs";
  if (pairs->ratio_interval->low > 1.0) return "is behind";
  if (pairs->ratio_interval->high >= 1.0) return "the interval holds 1";
  return why_insignificant(*pairs);
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
