// The table-top decision: 30 views by the sweep, by exact rays and by castRay, on the maps that
// episodes in the four scenes build.
#include <fmt/format.h>

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

struct Agreement {
  double spearman_min = 1.0;
  double regret_max = 0.0;

  void add(std::span<const double> swept, std::span<const double> exact) {
    spearman_min = std::min(spearman_min, bench::spearman(swept, exact));
    const auto chosen = std::ranges::max_element(swept) - swept.begin();
    const double best = *std::ranges::max_element(exact);
    if (best > 0.0) {
      regret_max = std::max(regret_max, 1.0 - exact[static_cast<std::size_t>(chosen)] / best);
    }
  }
};

/// An episode whose every decision is worked out both ways.
class ComparedEpisode : public NextBestView {
 public:
  ComparedEpisode(const ResolvedEpisode& resolved, TabletopRig& rig, Recorder& recorder,
                  Agreement& agreement)
      : NextBestView(resolved, rig, recorder),
        field_(rig.view_field()),
        agreement_(agreement) {}

  void score(std::vector<Candidate>& candidates) {
    const auto transmission = belief().hazard().transmission_per_slice();
    const GainContext context{belief().filled_grid(), transmission};
    for (const std::string_view name : strategy_names<Gain>()) {
      const Gain gain = make_strategy<Gain>(name);
      if (!can_sweep(gain)) continue;
      const auto exact = exact_gains_bits(gain, context, candidates, field_, kThreads);
      const auto swept = swept_gains_bits(gain, context, candidates, field_, kThreads);
      Agreement a;
      a.add(swept, exact);
      fmt::print(stderr, "{} {}: spearman {:.4f} regret {:.4f} best {:.0f} ratio {:.3f}\n", scans().size(), name,
                 a.spearman_min, a.regret_max, *std::ranges::max_element(exact),
                 std::accumulate(swept.begin(), swept.end(), 0.0) /
                     std::accumulate(exact.begin(), exact.end(), 0.0));
      agreement_.add(swept, exact);
    }
    if (FILE* f = fopen(fmt::format("/tmp/grids/{}_{}.bin", tag, scans().size()).c_str(), "wb")) {
      fwrite(context.grid.log_odds.data(), 4, context.grid.size(), f);
      fwrite(transmission.data(), 8, transmission.size(), f);
      fclose(f);
    }
    last_grid = belief().filled_grid();
    last_transmission = transmission;
    NextBestView::score(candidates);
  }

  int tag = 0;
  OccupancyGrid last_grid;
  std::vector<double> last_transmission;

 private:
  FieldOfView field_;
  Agreement& agreement_;
};

}  // namespace
}  // namespace vantage

int main() {
  using namespace vantage;
  Agreement agreement;
  for (const int objects : {4, 8, 15, 25}) {
    const fs::path out = fs::temp_directory_path() / "vantage_bench_decision";
    fs::create_directories(out);
    const auto resolved = load_episode("assets/episodes/tabletop.yaml",
        {fmt::format("scene=models/scenes/tabletop_{}/scene.xml", objects)});
    TabletopRig rig(resolved);
    Recorder recorder(resolved, rig, out, false);
    ComparedEpisode episode(resolved, rig, recorder, agreement);
    episode.tag = objects;
    run_episode(episode);
    const auto views = episode.views();
    const auto field = rig.view_field();
    const GainContext context{episode.last_grid, episode.last_transmission};
    const Gain gain = AdaptiveGain{};
    const double sweep = bench::median_ms(9, [&] { (void)swept_gains_bits(gain, context, views, field, kThreads); });
    const double exact = bench::median_ms(1, [&] { (void)exact_gains_bits(gain, context, views, field, kThreads); });
    bench::print_figures("decision", kThreads, {{"sweep_ms", sweep}, {"exact_ms", exact},
                       {"spearman_min", agreement.spearman_min}, {"regret_max", agreement.regret_max}});
  }
}
