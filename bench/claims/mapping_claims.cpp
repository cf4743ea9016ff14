#include "bench/claims/mapping_claims.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "bench/tables/paired_difference.hpp"

namespace vantage::bench {
namespace {

std::string not_ahead(const std::vector<std::string>& level_in,
                      const std::vector<std::string>& behind_in) {
  std::string text;
  if (!level_in.empty()) text += fmt::format("level in {}; ", fmt::join(level_in, ", "));
  if (!behind_in.empty())
    text += fmt::format("`simple` is ahead in {}; ", fmt::join(behind_in, ", "));
  return text;
}

}  // namespace

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
        std::vector<std::string> level_in, behind_in;
        for (const char* table : tables) {
          const Difference paired = study.difference(table, kAllPanels, other);
          const bool ahead = to_simple ? is_below(paired) : is_above(paired);
          const bool behind = to_simple ? is_above(paired) : is_below(paired);
          if (!ahead) (behind ? behind_in : level_in).push_back(fmt::format("`{}`", table));
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
                level_in.empty() && behind_in.empty(),
                not_ahead(level_in, behind_in) +
                    "how much there was to win: the one-step oracle, which knows what a view "
                    "shows, has an area of " +
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
