// What benchmarks measured, held against the goals.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/claims/claims.hpp"

namespace vantage::bench {
namespace {

/// @throws NotRun if the benchmark or the figure is not there
double figure(const Figures& figures, const std::string& benchmark, const char* key) {
  const auto found = figures.find(benchmark);
  if (found == figures.end() || !found->second.contains(key)) {
    throw NotRun(fmt::format("`{}` of `bench/run {}`", key, benchmark));
  }
  return found->second.at(key).get<double>();
}

Finding at_most(const Figures& figures, const char* benchmark, const char* key, double limit,
                const char* why = "") {
  return held("goal", fmt::format("{}: `{}` at most {}", benchmark, key, limit), [&]() -> Measured {
    const double value = figure(figures, benchmark, key);
    return {fmt::format("{:.4g}", value), value <= limit, why};
  });
}

Finding at_least(const Figures& figures, const char* benchmark, const char* key, double limit,
                 const char* why = "") {
  return held("goal", fmt::format("{}: `{}` at least {}", benchmark, key, limit),
              [&]() -> Measured {
                const double value = figure(figures, benchmark, key);
                return {fmt::format("{:.4g}", value), value >= limit, why};
              });
}

/// The simple features of one view, together.
Finding simple_features(const Figures& figures) {
  constexpr double kLimit_ms = 5.0;
  const std::string text =
      fmt::format("all simple features of a view, the dissertation's, at most {} ms", kLimit_ms);
  return held("goal", text, [&]() -> Measured {
    double sum_ms = 0.0;
    for (const char* feature : {"colour_ms", "bbox_ms", "sift_ms", "vfh_ms"}) {
      sum_ms += figure(figures, "features", feature);
    }
    const double ours_ms = figure(figures, "features", "soft_colour_ms") +
                           figure(figures, "features", "standing_box_ms");
    return {
        fmt::format("{:.1f} ms; with `soft_colour` and `standing_box`, which are ours, {:.1f} ms",
                    sum_ms, sum_ms + ours_ms),
        sum_ms <= kLimit_ms};
  });
}

Finding faster_than_exact(const Figures& figures) {
  return held("goal", "decision: `exact_over_sweep` at least 50", [&]() -> Measured {
    const double ratio = figure(figures, "decision", "exact_over_sweep");
    const double castray = figure(figures, "decision", "castray_over_sweep");
    return {fmt::format("{:.4g}", ratio), ratio >= 50.0,
            fmt::format("the exact evaluator is fast itself: an integer walk on both cores, {:.1f} "
                        "times faster than castRay",
                        quotient(castray, ratio))};
  });
}

/// Only where castRay had as many threads as the sweep.
Finding faster_than_castray(const Figures& figures) {
  return held(
      "goal", "decision: `castray_over_sweep` at least 1000, on the same number of threads",
      [&]() -> Measured {
        const double threads = figure(figures, "decision", "sweep_threads");
        const double of_castray = figure(figures, "decision", "castray_threads");
        if (of_castray != threads) {
          throw NotRun(
              fmt::format("threads: castRay {:.0f}, the sweep {:.0f}", of_castray, threads));
        }
        const double ratio = figure(figures, "decision", "castray_over_sweep");
        return {
            fmt::format("{:.4g} on {:.0f} threads each", ratio, threads), ratio >= 1000.0,
            "a beam of the laser is a ray: a scan has 61 x 601 of them, 8.4 times fewer than an "
            "image of 640 x 480 has pixels"};
      });
}

/// One thread each. What each pixel costs both, and what OctoMap can leave out, is told beside it.
Finding faster_than_octomap(const Figures& figures) {
  return held(
      "goal",
      "integration: a scan of whole images is in the map at least 20 x as fast as by OctoMap's "
      "`insertPointCloud`, and of the cells that both know at least 99 % are the same",
      [&]() -> Measured {
        const auto of = [&](const char* key) { return figure(figures, "integration", key); };
        const double ratio = of("octomap_over_ours");
        const double same = of("same_state_share");
        return {
            fmt::format("{:.1f} x, {:.2f} % the same of {:.2f} million cells that both know, of "
                        "{:.2f} that ours does and {:.2f} that OctoMap does; {:.1f} x where we "
                        "mark every pixel too, {:.1f} x where OctoMap is given the pixels that "
                        "we mark, {:.1f} x with one point a voxel",
                        ratio, 100.0 * same, 1e-6 * of("both_know_cells"), 1e-6 * of("known_cells"),
                        1e-6 * of("octomap_known_cells"), of("octomap_over_ours_every_pixel"),
                        of("octomap_marked_pixels_over_ours"), of("octomap_discretised_over_ours")),
            ratio >= 20.0 && same >= 0.99,
            "every pixel frees cells, of those that mark surfaces one in nine is enough"};
      });
}

Finding decision_time(const Figures& figures) {
  return held("Chapter 3", "a decision takes about 30 s; under 10 s is \"a future goal\" (2014 PC)",
              [&]() -> Measured {
                const double sweep_ms = figure(figures, "decision", "sweep_ms");
                const double whole_ms = figure(figures, "planning_tabletop", "decision_ms");
                return {
                    fmt::format("{:.0f} ms for the gains of the same 30 views; a whole decision "
                                "of `tour` {:.0f} ms",
                                sweep_ms, whole_ms),
                    whole_ms < 1e4};
              });
}

}  // namespace

std::vector<Finding> speed_findings(const Figures& figures) {
  constexpr const char* kOffice = "timed on the first map with 30 views";
  constexpr const char* kPlanning =
      "a sweep a view: an office has up to twice the views that a greedy choice looks at";
  constexpr const char* kPlanningAtTable =
      "mostly sweeps, see `sweep_share`: one for each of the 30 views, where a greedy choice has "
      "one for the three views of each of 10 places";
  constexpr const char* kPace =
      "a scan is 18 depth images of 640 x 480 pixels and 4.3 million cells: what is left is spread "
      "over belief, rendering, physics and driving, see the shares";
  constexpr const char* kTablePace =
      "half of it is the belief, see the shares; from run to run it differs by some 2 %";
  constexpr const char* kSteps =
      "a decision is a drive and a scan of 11 simulated seconds in full physics, at 47 times real "
      "time: no one part could go, see the shares in docs/python/environment.md";
  return {decision_time(figures),
          at_most(figures, "decision", "sweep_ms", 40.0),
          faster_than_exact(figures),
          faster_than_castray(figures),
          at_least(figures, "decision", "spearman_min", 0.99),
          at_most(figures, "decision", "regret_max", 0.02),
          at_most(figures, "scaling", "exponent", 1.05),
          at_least(figures, "episode", "tabletop_real_time_factor", 40.0, kTablePace),
          at_least(figures, "episode", "office_real_time_factor", 80.0, kPace),
          at_least(figures, "geoms", "boxes_2000_real_time_factor", 15.0),
          at_least(figures, "geoms", "bodies_2000_real_time_factor", 15.0),
          faster_than_octomap(figures),
          at_most(figures, "office", "sweep_ms", 150.0, kOffice),
          at_most(figures, "planning_office_large", "decision_ms", 500.0, kPlanning),
          at_most(figures, "planning_tabletop", "decision_ms", 60.0, kPlanningAtTable),
          at_most(figures, "branches", "all_views_s", 60.0),
          at_least(figures, "office", "spearman_min", 0.99),
          at_most(figures, "office", "regret_max", 0.02),
          at_most(figures, "selection", "mi_ms", 1.0),
          at_most(figures, "selection", "load_ms", 50.0),
          at_most(figures, "selection", "le_ms", 100.0),
          at_most(figures, "selection", "jd_ms", 1.0),
          simple_features(figures),
          at_most(figures, "features", "kernel_ms", 200.0),
          at_most(figures, "trajectory", "stomp_ms", 3.0),
          at_most(figures, "trajectory", "mppi_ms", 3.0),
          at_most(figures, "trajectory", "cem_ms", 3.0),
          at_most(figures, "trajectory", "covariant_gradient_ms", 3.0),
          at_least(figures, "env", "decisions_per_s", 10.0, kSteps),
          at_most(figures, "env", "swept_numpy_over_cpp", 1.1)};
}

}  // namespace vantage::bench
