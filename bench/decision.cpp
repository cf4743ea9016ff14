// The table-top decision: 30 views by the sweep, by exact rays and by castRay, on the maps that
// episodes in the four scenes build.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "bench/castray.hpp"
#include "bench/measures.hpp"
#include "planners/exact_gain.hpp"
#include "planners/swept_gain.hpp"
#include "src/core/log.hpp"
#include "src/episode/episode_loop.hpp"
#include "src/episode/next_best_view.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

constexpr int kThreads = 2;
constexpr int kRepeats = 9;

/// What a decision looks at.
struct Situation {
  OccupancyGrid grid;
  std::vector<double> transmission;
  std::vector<Candidate> views;
  FieldOfView field;

  [[nodiscard]] GainContext context() const { return {grid, transmission}; }
};

struct Timings {
  double sweep_ms = 0.0;
  double exact_ms = 0.0;
};

Timings time_both(const Situation& s) {
  const Gain gain = AdaptiveGain{};
  std::vector<double> gains;
  Timings timings;
  timings.sweep_ms = bench::median_ms(
      kRepeats, [&] { gains = swept_gains_bits(gain, s.context(), s.views, s.field, kThreads); });
  timings.exact_ms = bench::median_ms(
      1, [&] { gains = exact_gains_bits(gain, s.context(), s.views, s.field, kThreads); });
  return timings;
}

struct Agreement {
  double spearman_min = 1.0;
  double regret_max = 0.0;
  double sweep_ms_max = 0.0;

  void compare(const Gain& gain, const Situation& s) {
    const auto exact = exact_gains_bits(gain, s.context(), s.views, s.field, kThreads);
    std::vector<double> swept;
    const double ms = bench::median_ms(
        1, [&] { swept = swept_gains_bits(gain, s.context(), s.views, s.field, kThreads); });
    const double best = *std::ranges::max_element(exact);
    const auto chosen = static_cast<std::size_t>(std::ranges::max_element(swept) - swept.begin());
    const double rank_correlation = bench::spearman(swept, exact);
    const double regret = best > 0.0 ? 1.0 - exact[chosen] / best : 0.0;
    spearman_min = std::min(spearman_min, rank_correlation);
    regret_max = std::max(regret_max, regret);
    sweep_ms_max = std::max(sweep_ms_max, ms);
    log_debug(fmt::format("best {:.0f} cells, Spearman {:.4f}, regret {:.4f}, {:.1f} ms", best,
                          rank_correlation, regret, ms));
  }
};

/// An episode that keeps the map of every decision.
class WatchedEpisode : public NextBestView {
 public:
  WatchedEpisode(const ResolvedEpisode& resolved, TabletopRig& rig, Recorder& recorder)
      : NextBestView(resolved, rig, recorder), field_(rig.view_field()) {}

  void score(std::vector<Candidate>& candidates) {
    situations.push_back(
        {belief().filled_grid(), belief().hazard().transmission_per_slice(), views(), field_});
    NextBestView::score(candidates);
  }

  std::vector<Situation> situations;

 private:
  FieldOfView field_;
};

std::vector<Situation> situations_of_scene(int objects, const fs::path& directory) {
  const auto resolved =
      load_episode("assets/episodes/tabletop.yaml",
                   {fmt::format("scene=models/scenes/tabletop_{}/scene.xml", objects)});
  TabletopRig rig(resolved);
  Recorder recorder(resolved, rig, directory, false, true);
  WatchedEpisode episode(resolved, rig, recorder);
  run_episode(episode);
  return std::move(episode.situations);
}

/// castRay as peers use it: a ray for each pixel of a 640 x 480 image of the view. Every sixth view
/// is timed, for all of them.
double castray_ms(const Situation& s) {
  constexpr std::size_t kEvery = 6;
  const bench::CastrayGain castray(s.grid);
  const double azimuth_step_rad = 2.0 * s.field.half_width_rad / 640.0;
  const double tilt_step_rad = (s.field.tilt_max_rad - s.field.tilt_min_rad) / 480.0;
  double sum = 0.0;
  const double taken_ms = bench::median_ms(1, [&] {
    for (std::size_t i = 0; i < s.views.size(); i += kEvery) {
      sum += castray.of_view(s.views[i].T_world_sensor, s.field, azimuth_step_rad, tilt_step_rad);
    }
  });
  expects(sum > 0.0, "the views see unobserved cells");
  return kEvery * taken_ms;
}

void run_benchmark() {
  const fs::path directory = fs::temp_directory_path() / "vantage_bench_decision";
  fs::create_directories(directory);
  Agreement agreement;
  Timings first;
  double castray = 0.0;
  for (const int objects : {4, 8, 15, 25}) {
    const auto situations = situations_of_scene(objects, directory);
    for (const Situation& situation : situations) {
      agreement.compare(SimpleGain{}, situation);
      agreement.compare(AdaptiveGain{}, situation);
    }
    if (objects != 8) continue;
    first = time_both(situations.front());
    castray = castray_ms(situations.front());
  }
  fs::remove_all(directory);
  bench::print_figures("decision", kThreads,
                       {{"sweep_ms", first.sweep_ms},
                        {"exact_ms", first.exact_ms},
                        {"castray_ms", castray},
                        {"exact_over_sweep", first.exact_ms / first.sweep_ms},
                        {"castray_over_sweep", castray / first.sweep_ms},
                        {"spearman_min", agreement.spearman_min},
                        {"regret_max", agreement.regret_max},
                        {"sweep_ms_max", agreement.sweep_ms_max}});
}

}  // namespace
}  // namespace vantage

int main() {
  try {
    vantage::run_benchmark();
  } catch (const vantage::Error& error) {
    vantage::log_error(error.what());
    return static_cast<int>(error.code());
  }
}
