#include "bench/situation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "bench/castray.hpp"
#include "bench/measures.hpp"
#include "vantage/core/log.hpp"
#include "vantage/core/parallel_for.hpp"
#include "vantage/planners/exact_gain.hpp"
#include "vantage/planners/swept_gain.hpp"

namespace vantage::bench {

RunRequest lean_request(const ResolvedEpisode& resolved, const std::filesystem::path& directory) {
  RunOptions options;
  options.directory = directory;
  options.overwrite = true;
  options.lean = true;
  const Task& task = resolved.task;
  return {resolved.setup,
          std::string(strategy_name_of(task)),
          method_name(task),
          episode_yaml(resolved),
          {},
          options};
}

void Agreement::compare(const Gain& gain, const Situation& s) {
  const auto exact = exact_gains_bits(gain, s.context(), s.views, s.field, kThreads);
  std::vector<double> swept;
  const double ms = median_ms(
      1, [&] { swept = swept_gains_bits(gain, s.context(), s.views, s.field, kThreads); });
  const double best = *std::ranges::max_element(exact);
  const auto chosen = static_cast<std::size_t>(std::ranges::max_element(swept) - swept.begin());
  const double rank_correlation = spearman(swept, exact);
  const double regret = best > 0.0 ? 1.0 - exact[chosen] / best : 0.0;
  spearman_min = std::min(spearman_min, rank_correlation);
  regret_max = std::max(regret_max, regret);
  sweep_ms_max = std::max(sweep_ms_max, ms);
  log_debug(fmt::format("{} of {} views: best {:.0f}, Spearman {:.4f}, regret {:.4f}, {:.1f} ms",
                        strategy_name_of(gain), exact.size(), best, rank_correlation, regret, ms));
}

Timings time_both(const Gain& gain, const Situation& s) {
  const auto warm_median_ms = [](int repeats, const auto& work) {
    work();
    return median_ms(repeats, work);
  };
  std::vector<double> gains;
  Timings timings;
  timings.sweep_ms = warm_median_ms(
      9, [&] { gains = swept_gains_bits(gain, s.context(), s.views, s.field, kThreads); });
  timings.exact_ms = warm_median_ms(
      3, [&] { gains = exact_gains_bits(gain, s.context(), s.views, s.field, kThreads); });
  return timings;
}

double castray_ms(const Situation& s, std::span<const Eigen::Vector3d> beams,
                  std::size_t timed_views) {
  expects(timed_views > 0 && timed_views % static_cast<std::size_t>(kThreads) == 0 &&
              timed_views <= s.views.size(),
          "a multiple of the threads is timed, of the views there are");
  const CastrayGain castray(s.grid);
  const auto gain_of = [&](const Candidate& view) {
    return castray.of_view(view.T_world_sensor, beams, s.field.range_max_m);
  };
  gain_of(s.views.back());  // not timed
  std::vector<double> gains(timed_views);
  std::vector<double> times_ms(timed_views);
  parallel_for(timed_views, kThreads, [&](std::size_t i) {
    const Candidate& view = s.views[i * s.views.size() / timed_views];
    times_ms[i] = median_ms(1, [&] { gains[i] = gain_of(view); });
  });
  expects(std::ranges::max(gains) > 0.0, "the views see unobserved cells");
  const double mean_ms =
      std::accumulate(times_ms.begin(), times_ms.end(), 0.0) / static_cast<double>(timed_views);
  return mean_ms * static_cast<double>(s.views.size()) / kThreads;
}

void print_decision(const std::string& name, const std::string& configuration,
                    const Timings& timings, double castray_ms, const Agreement& agreement) {
  print_figures(name, kThreads, configuration,
                {{"sweep_ms", timings.sweep_ms},
                 {"exact_ms", timings.exact_ms},
                 {"castray_ms", castray_ms},
                 {"castray_threads", static_cast<double>(kThreads)},
                 {"sweep_threads", static_cast<double>(kThreads)},
                 {"exact_over_sweep", timings.exact_ms / timings.sweep_ms},
                 {"castray_over_sweep", castray_ms / timings.sweep_ms},
                 {"spearman_min", agreement.spearman_min},
                 {"regret_max", agreement.regret_max},
                 {"sweep_ms_max", agreement.sweep_ms_max}});
}

}  // namespace vantage::bench
