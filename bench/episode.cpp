// How fast episodes run, and what takes the time.
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <string_view>

#include "bench/measures.hpp"
#include "bench/situation.hpp"
#include "vantage/core/log.hpp"
#include "vantage/tasks/exploration/exploration_session.hpp"
#include "vantage/tasks/run.hpp"
#include "vantage/tasks/tabletop/tabletop_session.hpp"

namespace vantage::bench {
namespace {
namespace fs = std::filesystem;

/// The parts of an episode, each timed without the physics that runs in it.
template <class Parts>
class Timed : public Parts {
 public:
  Timed(const MappingContext& context, const auto& task, auto& robot, auto& belief)
      : Parts(context, task, robot, belief), world_(robot.world()) {}

  auto observe() {
    return timed(rendering_s, [&] { return Parts::observe(); });
  }
  void update(const auto& observation) {
    timed(belief_s, [&] { Parts::update(observation); });
  }
  void record() {
    timed(planning_s, [&] { Parts::record(); });
  }
  auto propose() {
    return timed(planning_s, [&] { return Parts::propose(); });
  }
  void score(std::vector<Candidate>& candidates) {
    timed(planning_s, [&] { Parts::score(candidates); });
  }
  std::size_t choose(std::vector<Candidate>& candidates) {
    return timed(planning_s, [&] { return Parts::choose(candidates); });
  }
  void act(const Candidate& candidate) {
    timed(driving_s, [&] { Parts::act(candidate); });
  }

  double rendering_s = 0.0;
  double belief_s = 0.0;
  double planning_s = 0.0;  ///< records too: explorations find their views where they record
  double driving_s = 0.0;   ///< prediction, path planning and control

 private:
  auto timed(double& sum_s, auto&& work) {
    const double start_s = wall_s() - world_.stepping_wall_s();
    struct Add {
      double& sum_s;
      double start_s;
      const World& world;
      ~Add() { sum_s += wall_s() - world.stepping_wall_s() - start_s; }
    } const add{sum_s, start_s, world_};
    return work();
  }
  const World& world_;
};

/// @tparam Session of Timed parts
template <class Session, class Task>
void measure(const std::string& task, const ResolvedEpisode& resolved, const fs::path& directory,
             std::vector<std::pair<std::string, double>>& figures) {
  const RunRequest request = lean_request(resolved, directory);
  Session session(request, std::get<Task>(resolved.task));
  const auto& episode = session.parts;
  const World& world = session.robot.world();
  const double start_s = wall_s();
  run_episode(session.parts);
  const double all_s = wall_s() - start_s;
  const auto add = [&](const char* name, double figure) {
    figures.emplace_back(task + "_" + name, figure);
  };
  add("real_time_factor", world.time_s() / all_s);
  add("physics_share", world.stepping_wall_s() / all_s);
  add("rendering_share", episode.rendering_s / all_s);
  add("belief_share", episode.belief_s / all_s);
  add("planning_share", episode.planning_s / all_s);
  add("driving_share", episode.driving_s / all_s);
}

/// A flight has few parts to tell apart: nearly all of it is physics and pictures.
double flight_real_time_factor(const ResolvedEpisode& resolved, const fs::path& directory) {
  RunOptions options;
  options.directory = directory;
  options.overwrite = true;
  options.lean = true;
  const RunOutcome outcome = run(resolved, options);
  return nlohmann::json::parse(outcome.metrics).at("real_time_factor");
}

using TabletopTimed = TabletopSession<Timed<TabletopParts>>;

/// The small map that environments are measured by, on one thread.
void measure_small(const fs::path& directory) {
  std::vector<std::pair<std::string, double>> figures;
  const auto resolved =
      load_episode("assets/episodes/tabletop.yaml",
                   {"scans=10", "threads=1", "map.cells=[49,49,25]", "laser.scan_duration_s=3"});
  measure<TabletopTimed, Tabletop>("small", resolved, directory, figures);
  print_figures("episode_small", 1, episode_yaml(resolved), figures);
}

void measure_all(const fs::path& directory) {
  std::vector<std::pair<std::string, double>> figures;
  std::string configuration;
  const auto load = [&](const std::string& name, const std::vector<std::string>& overrides) {
    auto resolved = load_episode("assets/episodes/" + name + ".yaml", overrides);
    configuration += episode_yaml(resolved);
    return resolved;
  };
  measure<TabletopTimed, Tabletop>("tabletop", load("tabletop", {"scans=6"}), directory, figures);
  measure<ExplorationSession<Timed<ExplorationParts>>, Exploration>(
      "office", load("office_small", {"scans=6"}), directory, figures);
  for (const std::string task : {"recognition", "change_detection", "trajectory"}) {
    figures.emplace_back(task + "_real_time_factor",
                         flight_real_time_factor(load(task, {}), directory));
  }
  print_figures("episode", 2, configuration, figures);
}

void run_benchmark(bool small) {
  const fs::path directory = fs::temp_directory_path() / "vantage_bench_episode";
  fs::create_directories(directory);
  small ? measure_small(directory) : measure_all(directory);
  fs::remove_all(directory);
}

}  // namespace
}  // namespace vantage::bench

int main(int argc, char** argv) {
  const bool small = argc > 1 && std::string_view(argv[1]) == "small";
  return vantage::bench::run_main([&] { vantage::bench::run_benchmark(small); });
}
