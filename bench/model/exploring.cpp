// Explorations of an office without physics, by any choices and options, in seconds each:
// bench_exploring SIZE SCENE START SETTINGS..., e.g. large 2 0 choice=greedy "choice=tour
// choice.scan_weight=1". A row each: time, way and scans to shares of what can be observed.
#include <fmt/format.h>

#include <cstdio>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "bench/measures.hpp"
#include "bench/model/modelled_exploration.hpp"

namespace vantage::bench {
namespace {

void print_row(const std::string& settings, std::span<const ReachedShare> levels) {
  fmt::print("{:40}", settings);
  for (const ReachedShare& level : levels) {
    if (level.scans == 0) {
      fmt::print(" | {:.0f} %: not reached", 100.0 * level.share);
    } else {
      fmt::print(" | {:.0f} %: {:4.0f} s {:4.0f} m {:2} scans", 100.0 * level.share, level.time_s,
                 level.way_m, level.scans);
    }
  }
  fmt::print("\n");
  std::fflush(stdout);
}

/// Cells are twice as long as in an episode, and frontiers and poor scans have fewer of them.
void explore(std::span<char*> arguments) {
  if (arguments.size() < 5) {
    throw ConfigError("usage: bench_exploring small|large SCENE START SETTINGS...");
  }
  const std::string size = arguments[1];
  const std::string file = fmt::format("assets/episodes/office_{}.yaml", size);
  const std::vector<std::string> common{
      fmt::format("scene=models/scenes/office_{}_{}/scene.xml", size, arguments[2]),
      fmt::format("robot.start_site=start_{}", arguments[3]),
      size == "large" ? "map.cells=[200, 250, 20]" : "map.cells=[150, 100, 20]",
      "frontiers.min_cells=17",
      "poor_cells=466",
      "threads=1",
      "scans=90"};
  const ModelledBuilding building(load_episode(file, common));
  for (const std::string settings : arguments.subspan(4)) {
    std::vector<std::string> sets = common;
    std::istringstream words(settings);
    for (std::string set; words >> set;) sets.push_back(set);
    const ResolvedEpisode resolved = load_episode(file, sets);
    const auto& task = std::get<Exploration>(resolved.task);
    if (task.gaze.on_the_way_m > 0.0) {
      throw ConfigError("gaze.on_the_way_m: the model takes no images on the way");
    }
    print_row(settings, ModelledExploration(building, task).run({0.5, 0.8, 0.9, 0.95}));
  }
}

}  // namespace
}  // namespace vantage::bench

int main(int argc, char** argv) {
  return vantage::bench::run_main([&] {
    vantage::bench::explore({argv, static_cast<std::size_t>(argc)});
  });
}
