#include "bench/claims/mapping_claims.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "bench/claims/paired_difference.hpp"

namespace vantage::bench {

Finding adaptive_against_simple(const StudyTables& study, const std::vector<const char*>& tables) {
  return held(
      "goal",
      fmt::format("`adaptive` is ahead of `simple`, in area and in what it predicts, beyond "
                  "the intervals, p < {}",
                  kSignificant),
      [&]() -> Measured {
        const bool to_simple = study.reference() == "simple";
        const std::string other = to_simple ? "adaptive" : "simple";
        std::vector<std::string> parts;
        bool ahead = true;
        for (const char* table : tables) {
          const Difference paired = study.difference(table, kAllPanels, other);
          ahead = (to_simple ? is_below(paired) : is_above(paired)) && ahead;
          parts.push_back(fmt::format("`{}` {}", table, ratio_text(paired)));
        }
        std::vector<std::string> panels;
        for (const std::string& panel : study.panels()) {
          panels.push_back(fmt::format("{} {:.2f}", panel, study.ratio("area", panel, other)));
        }
        if (!panels.empty())
          parts.push_back("area in " + fmt::format("{}", fmt::join(panels, ", ")));
        return {fmt::format("`{}` in terms of `{}`: {}", other, study.reference(),
                            fmt::join(parts, "; ")),
                ahead,
                "an interval holds 1; how much there was to win: the one-step oracle, which "
                "knows what a view shows, has an area of " +
                    study.ratio_text("area", kAllPanels, "oracle")};
      });
}

Finding without_collision(const StudyTables& study, const char* compared) {
  return held("goal", fmt::format("no collision in any episode of any {}", compared),
              [&]() -> Measured {
                double collisions = 0.0;
                const auto levels = study.levels();
                for (const std::string& level : levels) {
                  collisions += study.mean("collisions", kAllPanels, level);
                }
                return {fmt::format("{:.3g} an episode, over all {}s",
                                    collisions / static_cast<double>(levels.size()), compared),
                        collisions == 0.0, "see `collisions` by episode"};
              });
}

}  // namespace vantage::bench
