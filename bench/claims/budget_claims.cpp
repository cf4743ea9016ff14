// Of budgets: whether they are kept, and what is seen within them.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "bench/claims/claims.hpp"
#include "bench/claims/mapping_claims.hpp"
#include "bench/tables/paired_difference.hpp"

namespace vantage::bench {
namespace {

Finding all_are_kept(const StudyTables& study) {
  return held("goal", "every budget is kept, and the robot is back at its start by then",
              [&]() -> Measured {
                const std::vector<double> all = all_values(study, "budget_kept");
                const auto kept = static_cast<std::size_t>(std::ranges::count(all, 1.0));
                return {fmt::format("in {} of {} episodes", kept, all.size()), kept == all.size(),
                        "see `budget_kept` by episode"};
              });
}

Finding sees_more_by_planning(const StudyTables& study) {
  return held(
      "goal",
      fmt::format("within each budget `tour` sees more than `{}`, beyond the interval, p < "
                  "{}",
                  study.reference(), kSignificant),
      [&]() -> Measured {
        std::vector<std::string> parts;
        bool ahead = true;
        for (const std::string& budget : study.panels()) {
          const Difference more = study.difference("observed_share", budget, "tour");
          ahead = is_above(more) && ahead;
          parts.push_back(fmt::format(
              "{}: {:.1f} and {:.1f} %, {}", budget,
              100.0 * study.mean("observed_share", budget, "tour"),
              100.0 * study.mean("observed_share", budget, study.reference()), ratio_text(more)));
        }
        return {fmt::format("{}", fmt::join(parts, "; ")), ahead,
                "where the budget allows for few scans, they are near the start for both"};
      });
}

}  // namespace

std::vector<Finding> budget_findings(const StudyTables& study) {
  return {all_are_kept(study), sees_more_by_planning(study), without_collision(study, "choice")};
}

}  // namespace vantage::bench
