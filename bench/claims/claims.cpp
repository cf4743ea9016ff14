// Of the table top and the offices: chapter 3, and the goals of this project.
#include "bench/claims/claims.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>

namespace vantage::bench {
namespace {

/// The dissertation's, and one that is denser.
constexpr std::array kScenes{"objects_4", "objects_8", "objects_15", "objects_25", "objects_40"};
/// The fixed transmissions that are recorded along the same episodes.
constexpr std::array kFixed{"beer_lambert a=0.98",   "beer_lambert a=0.99",  "beer_lambert",
                            "beer_lambert a=0.997",  "beer_lambert a=0.998", "beer_lambert a=0.999",
                            "beer_lambert a=0.9995", "beer_lambert a=0.9998"};

using OfScene = std::function<double(const std::string& scene)>;

/// "objects_4 0.52, objects_8 0.61"
std::string by_scene(const OfScene& value) {
  std::vector<std::string> parts;
  for (const char* scene : kScenes) parts.push_back(fmt::format("{} {:.2f}", scene, value(scene)));
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// All are asked: a number that is missing is missed wherever it stands.
bool in_every_scene(const std::function<bool(const std::string& scene)>& holds) {
  bool all = true;
  for (const char* scene : kScenes) all = holds(scene) && all;
  return all;
}

Finding fastest_by_information(const StudyTables& study) {
  const auto area = [&](const std::string& scene, const char* level) {
    return study.mean("area", scene, level);
  };
  const auto to_simple = [&](const char* level) -> OfScene {
    return [&area, level](const std::string& scene) {
      return quotient(area(scene, level), area(scene, "simple"));
    };
  };
  return held(
      "Fig. 3.10",
      "unobserved cells fall fastest with `probabilistic`, then `simple`, then `random`, in "
      "all levels of clutter",
      [&]() -> Measured {
        return {
            "area of `probabilistic` / `simple`: " + by_scene(to_simple("probabilistic")) +
                "; `random` / `simple`: " + by_scene(to_simple("random")),
            in_every_scene([&](const auto& scene) {
              const double simple = area(scene, "simple");
              const double random = area(scene, "random");
              return area(scene, "probabilistic") < simple && simple < random;
            }),
            "one `a` fits one clutter: where there is less, its chain discounts far too much; the "
            "one-step oracle has " +
                by_scene(to_simple("oracle")) + " of `simple`'s area"};
      });
}

Finding near_simple(const StudyTables& study) {
  return held(
      "goal",
      "area of `adaptive` not above `simple`'s beyond its interval, both well below "
      "`random`'s",
      [&]() -> Measured {
        const auto area = [&](const char* level) { return study.mean("area", kAllPanels, level); };
        const double random = area("random");
        const bool above = study.difference("area", kAllPanels, "adaptive").interval.low > 0.0;
        return {fmt::format("random {:.2f}, simple {:.2f}, adaptive {:.2f}, oracle {:.2f}", random,
                            area("simple"), area("adaptive"), area("oracle")),
                !above && area("adaptive") < 0.8 * random && area("simple") < 0.8 * random,
                fmt::format("well below is 0.8 x: the first scan is the same for all, and in the "
                            "densest clutter any view shows something; from the second scan on "
                            "`adaptive` has {:.2f} of `random`'s, `simple` {:.2f}",
                            quotient(study.mean("area_from_scan_2", kAllPanels, "adaptive"),
                                     study.mean("area_from_scan_2", kAllPanels, "random")),
                            quotient(study.mean("area_from_scan_2", kAllPanels, "simple"),
                                     study.mean("area_from_scan_2", kAllPanels, "random")))};
      });
}

/// The study's reference is one of the two.
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
                    "an interval holds 1: where there is little clutter both see the same, see the "
                    "levels in the tables"};
              });
}

/// Error of a predictor in terms of that of `simple`, along the same episodes.
OfScene error_to_simple(const StudyTables& study, const char* predictor) {
  return [&study, predictor](const std::string& scene) {
    return quotient(study.mean("predictors", scene, predictor),
                    study.mean("predictors", scene, "simple"));
  };
}

/// @throws NotRun if any is missing: the best of fewer is another claim
double best_fixed_error(const StudyTables& study, const std::string& scene) {
  double best = std::numeric_limits<double>::infinity();
  for (const char* predictor : kFixed) {
    best = std::min(best, study.mean("predictors", scene, predictor));
  }
  return best;
}

Finding as_published(const StudyTables& study) {
  return held(
      "Fig. 3.11",
      "the probabilistic method (a = 0.997) predicts much better than `simple` in all levels of "
      "clutter",
      [&]() -> Measured {
        const OfScene error = error_to_simple(study, "visibility_weighted");
        return {
            "error of `visibility_weighted` / `simple`: " + by_scene(error),
            in_every_scene([&](const auto& scene) { return error(scene) < 0.7; }),
            "one `a` fits one clutter: with a = 0.997 after N cells the light is a^(1 + 2 + ... "
            "+ N), so the prediction falls short where there is little clutter"};
      });
}

Finding adaptive_predicts(const StudyTables& study) {
  return held("goal",
              "error of `adaptive` at most 0.5 x `simple`'s with 15 and 25 objects, 0.7 x with 8, "
              "1.05 x with 4",
              [&]() -> Measured {
                const OfScene error = error_to_simple(study, "adaptive");
                return {by_scene(error), error("objects_4") <= 1.05 && error("objects_8") <= 0.7 &&
                                             error("objects_15") <= 0.5 &&
                                             error("objects_25") <= 0.5};
              });
}

Finding near_best_fixed(const StudyTables& study) {
  return held(
      "goal",
      "error of `adaptive` at most 1.1 x that of the best fixed `a`, which differs from scene to "
      "scene",
      [&]() -> Measured {
        const OfScene to_best = [&](const std::string& scene) {
          return quotient(study.mean("predictors", scene, "adaptive"),
                          best_fixed_error(study, scene));
        };
        return {
            by_scene(to_best),
            in_every_scene([&](const auto& scene) { return to_best(scene) <= 1.1; }),
            "the best is picked among those of the study once its errors are known; where there "
            "is next to no clutter a transmission near 1 is ahead of one that is learnt on the "
            "run"};
      });
}

}  // namespace

std::vector<Finding> tabletop_findings(const StudyTables& study) {
  return {fastest_by_information(study), near_simple(study),
          adaptive_against_simple(study, {"area", "area_from_scan_2", "prediction_error_cells"})};
}

std::vector<Finding> prediction_findings(const StudyTables& study) {
  return {as_published(study), adaptive_predicts(study), near_best_fixed(study)};
}

namespace {

constexpr const char* kOracle = "oracle";
/// The dissertation's own setting for offices.
constexpr const char* kClaimed = "probabilistic_0.9999";

/// All that the study plans but the oracle and the reference: one that was not run is missed.
std::vector<std::string> rivals(const StudyTables& study) {
  auto levels = study.levels();
  std::erase_if(levels, [&](const std::string& level) {
    return level == kOracle || level == study.reference();
  });
  return levels;
}

Finding best_as_published(const StudyTables& study, const std::string& figure) {
  return held(figure, "a = 0.9999 is on par with or better than all others", [&]() -> Measured {
    double least = 1.0;
    for (const std::string& level : rivals(study)) {
      least = std::min(least, study.ratio("area", kAllPanels, level));
    }
    return {fmt::format("area {}", study.ratio_text("area", kAllPanels, kClaimed)),
            study.ratio("area", kAllPanels, kClaimed) <= 1.05 * least,
            "see the paired differences in the table"};
  });
}

Finding scans_as_published(const StudyTables& study, const std::string& figure,
                           const ScansClaimed& claimed) {
  return held(figure, fmt::format("it takes {} to {} scans", claimed.fewest, claimed.most),
              [&]() -> Measured {
                const double scans = study.mean("scans", kAllPanels, kClaimed);
                return {
                    fmt::format("`{}`: {:.1f} scans until no view is worth one, {:.1f} until 95 %",
                                kClaimed, scans, study.mean("scans_to_95", kAllPanels, kClaimed)),
                    scans >= claimed.fewest && scans <= claimed.most,
                    "other scenes, another sensor and another end"};
              });
}

Finding nearest_travels_least(const StudyTables& study, const std::string& figure) {
  return held(
      figure, "`nearest_frontier` travels least, but needs about twice the scans",
      [&]() -> Measured {
        const auto to_simple = [&](const char* table) {
          return quotient(study.mean(table, kAllPanels, "nearest_frontier"),
                          study.mean(table, kAllPanels, "simple"));
        };
        const auto levels = study.levels();
        const std::string least = *std::ranges::min_element(
            levels, {}, [&](const auto& l) { return study.mean("path_length_m", kAllPanels, l); });
        return {fmt::format("`{}` travels least; `nearest_frontier` takes {:.2f} of the way "
                            "and {:.2f} of the scans to 95 % that `simple` takes",
                            least, to_simple("path_length_m"), to_simple("scans_to_95")),
                least == "nearest_frontier" && to_simple("scans_to_95") > 1.5,
                "candidates are the same clusters of frontiers for every method"};
      });
}

Finding observes_all(const StudyTables& study) {
  return held("goal", "`adaptive` observes at least 95 % of the observable cells in every episode",
              [&]() -> Measured {
                const double least = study.least("observed_share", kAllPanels, "adaptive");
                return {fmt::format("{:.1f} % on average, {:.1f} % at least",
                                    100.0 * study.mean("observed_share", kAllPanels, "adaptive"),
                                    100.0 * least),
                        least >= 0.95, "see `observed_share` by episode"};
              });
}

Finding without_collision(const StudyTables& study) {
  return held("goal", "no collision in any episode of any method", [&]() -> Measured {
    double collisions = 0.0;
    const auto levels = study.levels();
    for (const std::string& level : levels) {
      collisions += study.mean("collisions", kAllPanels, level);
    }
    return {fmt::format("{:.3g} an episode, over all methods",
                        collisions / static_cast<double>(levels.size())),
            collisions == 0.0, "see `collisions` by episode"};
  });
}

Finding on_par(const StudyTables& study) {
  return held(
      "goal", "`adaptive` on par with or better than every method but the oracle",
      [&]() -> Measured {
        std::vector<std::string> parts;
        bool behind = false;
        for (const std::string& level : rivals(study)) {
          parts.push_back(
              fmt::format("`{}` {}", level, study.ratio_text("area", kAllPanels, level)));
          behind = behind || study.difference("area", kAllPanels, level).interval.high < 0.0;
        }
        return {
            fmt::format("area in terms of `{}`'s: {}", study.reference(), fmt::join(parts, "; ")),
            !behind && study.reference() == "adaptive",
            "an interval below 1 is a method that does better"};
      });
}

}  // namespace

std::vector<Finding> office_findings(const StudyTables& study, const std::string& figure,
                                     const ScansClaimed& claimed) {
  return {best_as_published(study, figure),
          scans_as_published(study, figure, claimed),
          nearest_travels_least(study, figure),
          observes_all(study),
          without_collision(study),
          on_par(study),
          adaptive_against_simple(study, {"area", "prediction_error_cells"})};
}

}  // namespace vantage::bench
