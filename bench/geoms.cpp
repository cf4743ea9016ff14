// What an exploration costs in scenes of many geoms: the small office as it is, and with hundreds
// and thousands of boxes in it.
#include <fmt/format.h>

#include <ctime>
#include <filesystem>
#include <string>

#include "bench/measures.hpp"
#include "bench/situation.hpp"
#include "tests/support/furnished_office.hpp"
#include "vantage/core/atomic_file.hpp"
#include "vantage/core/log.hpp"
#include "vantage/tasks/exploration/exploration_session.hpp"

namespace vantage::bench {
namespace {
namespace fs = std::filesystem;
using support::BoxBodies;

double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

constexpr const char* kEpisode = "assets/episodes/office_small.yaml";
constexpr const char* kScans = "scans=6";

void measure(const std::string& name, const fs::path& scene, const fs::path& directory,
             std::vector<std::pair<std::string, double>>& figures) {
  const auto resolved = load_episode(kEpisode, {kScans, "scene=" + scene.string()});
  const RunRequest request = lean_request(resolved, directory / "run");
  const double start_s = wall_s();
  const double start_cpu_s = cpu_s();
  ExplorationSession<> session(request, std::get<Exploration>(resolved.task));
  const double ready_s = wall_s();
  const double ready_cpu_s = cpu_s();
  run_episode(session.parts);
  const double end_s = wall_s();
  const World& world = session.robot.world();
  const auto add = [&](const char* what, double figure) {
    figures.emplace_back(name + "_" + what, figure);
  };
  add("start_s", ready_s - start_s);
  add("start_cpu_s", ready_cpu_s - start_cpu_s);
  add("real_time_factor", world.time_s() / (end_s - ready_s));
  add("cpu_per_simulated_s", (cpu_s() - ready_cpu_s) / world.time_s());
  add("physics_share", world.stepping_wall_s() / (end_s - ready_s));
}

void run_benchmark() {
  const fs::path directory = fs::temp_directory_path() / "vantage_bench_geoms";
  fs::create_directories(directory);
  std::vector<std::pair<std::string, double>> figures;
  std::string configuration = episode_yaml(load_episode(kEpisode, {kScans}));
  const auto furnished = [&](const std::string& name, int boxes, BoxBodies bodies) {
    configuration +=
        fmt::format("{}: {{boxes: {}, a_body_each: {}}}\n", name, boxes, bodies == BoxBodies::each);
    const fs::path scene = directory / (name + ".xml");
    write_file(scene, support::furnished_office(boxes, bodies));
    measure(name, scene, directory, figures);
  };
  furnished("plain", 0, BoxBodies::one);
  furnished("boxes_850", 850, BoxBodies::one);
  furnished("boxes_2000", 2000, BoxBodies::one);
  furnished("bodies_2000", 2000, BoxBodies::each);
  fs::remove_all(directory);
  print_figures("geoms", kThreads, configuration, figures);
}

}  // namespace
}  // namespace vantage::bench

int main() { return vantage::bench::run_main(vantage::bench::run_benchmark); }
