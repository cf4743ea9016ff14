#include "bench/claims/adaptive_claim.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace vantage::bench {

Finding adaptive_against_simple(const StudyTables& study, const std::vector<const char*>& tables) {
  return held("goal", "`adaptive` is ahead of `simple`, in area and in what it predicts",
              [&]() -> Measured {
                const bool to_simple = study.reference() == "simple";
                const std::string other = to_simple ? "adaptive" : "simple";
                std::vector<std::string> parts;
                bool ahead = true;
                for (const char* table : tables) {
                  const Interval interval = study.difference(table, kAllPanels, other).interval;
                  ahead = (to_simple ? interval.high < 0.0 : interval.low > 0.0) && ahead;
                  parts.push_back(
                      fmt::format("`{}` {}", table, study.ratio_text(table, kAllPanels, other)));
                }
                return {
                    fmt::format("`{}` in terms of `{}`: {}", other, study.reference(),
                                fmt::join(parts, "; ")),
                    ahead,
                    "an interval holds 1; how much there was to win: the one-step oracle, which "
                    "knows what a view shows, has an area of " +
                        study.ratio_text("area", kAllPanels, "oracle")};
              });
}

}  // namespace vantage::bench
