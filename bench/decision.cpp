// The table-top decision: 30 views by the sweep, by exact rays and by castRay, on the maps that
// episodes in the four scenes build; and the sweep's time against the number of cells.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "bench/castray.hpp"
#include "bench/measures.hpp"
#include "bench/situation.hpp"
#include "vantage/core/log.hpp"
#include "vantage/planners/swept_gain.hpp"
#include "vantage/tasks/tabletop/tabletop_session.hpp"

namespace vantage::bench {
namespace {
namespace fs = std::filesystem;

constexpr const char* kEpisode = "assets/episodes/tabletop.yaml";

std::vector<Situation> situations_of_scene(int objects, const fs::path& directory,
                                           std::string& configuration) {
  const auto resolved =
      load_episode(kEpisode, {fmt::format("scene=models/scenes/tabletop_{}/scene.xml", objects)});
  const RunRequest request = lean_request(resolved, directory);
  configuration += request.config;
  TabletopSession<Watched<TabletopParts>> session(request, std::get<Tabletop>(resolved.task));
  run_episode(session.parts);
  return std::move(session.parts.situations);
}

/// The same map in cells of another size.
Situation resampled(const Situation& s, double cells_per_cell) {
  const GridFrame& from = s.grid.frame;
  const Eigen::Array3i cells = (from.cells.cast<double>() * cells_per_cell).round().cast<int>();
  const Eigen::Vector3d size_m = from.box().sizes();
  const Eigen::Vector3d centre_m = from.box().center();
  Situation result = s;
  result.grid = OccupancyGrid(make_grid_frame({centre_m.x(), centre_m.y(), centre_m.z()},
                                              {size_m.x(), size_m.y(), size_m.z()},
                                              {cells.x(), cells.y(), cells.z()}));
  const GridFrame& to = result.grid.frame;
  for (std::size_t cell = 0; cell < to.size(); ++cell) {
    result.grid.log_odds[cell] =
        s.grid.log_odds[from.index(from.cell_at(to.centre(to.cell(cell))))];
  }
  result.transmission.layout.cells = cells;
  for (double& transmission : result.transmission.per_block) {
    transmission = std::pow(transmission, 1.0 / cells_per_cell);
  }
  return result;
}

/// From an eighth to eight times the cells of the table top's map.
void print_scaling(const Situation& situation, const std::string& configuration) {
  std::vector<std::pair<std::string, double>> figures;
  std::vector<double> log_cells;
  std::vector<double> log_ms;
  for (const double power : {-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0}) {
    const Situation s = resampled(situation, std::exp2(power / 3.0));
    std::vector<double> gains;
    const double ms = median_ms(9, [&] {
      gains = swept_gains_bits(AdaptiveGain{}, s.context(), s.views, s.field, kThreads);
    });
    figures.emplace_back(fmt::format("ms_of_{}_cells", s.grid.size()), ms);
    log_cells.push_back(std::log(static_cast<double>(s.grid.size())));
    log_ms.push_back(std::log(ms));
  }
  figures.emplace_back("exponent", slope(log_cells, log_ms));
  print_figures("scaling", kThreads, configuration, figures);
}

void run_benchmark() {
  const fs::path directory = fs::temp_directory_path() / "vantage_bench_decision";
  fs::create_directories(directory);
  Agreement agreement;
  std::vector<Situation> timed;
  std::string configuration;
  for (const int objects : {4, 8, 15, 25}) {
    const auto situations = situations_of_scene(objects, directory, configuration);
    for (const Situation& situation : situations) {
      agreement.compare(SimpleGain{}, situation);
      agreement.compare(AdaptiveGain{}, situation);
    }
    if (objects == 8) timed.push_back(situations.front());
  }
  fs::remove_all(directory);
  const Situation& first = timed.front();
  const Task task = load_episode(kEpisode, {}).task;
  const auto beams = laser_beams(std::get<Tabletop>(task).laser);
  const double castray = castray_ms(first, beams, first.views.size());
  print_decision("decision", configuration, time_both(AdaptiveGain{}, first), castray, agreement);
  print_scaling(first, configuration);
}

}  // namespace
}  // namespace vantage::bench

int main() { return vantage::bench::run_main(vantage::bench::run_benchmark); }
