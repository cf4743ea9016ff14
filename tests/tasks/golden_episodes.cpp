#include "tests/tasks/golden_episodes.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "tests/support/voxel_world.hpp"
#include "vantage/belief/map/clutter_hazard.hpp"
#include "vantage/belief/map/free_space.hpp"
#include "vantage/belief/map/hole_filling.hpp"
#include "vantage/belief/map/octomap_io.hpp"
#include "vantage/belief/map/sensor_model.hpp"
#include "vantage/core/log.hpp"
#include "vantage/planners/choice/view_choice.hpp"
#include "vantage/planners/exact_gain.hpp"
#include "vantage/planners/views/view_candidates.hpp"
#include "vantage/tasks/mapping/drawing/map_panel.hpp"
#include "vantage/tasks/run.hpp"

namespace vantage {
namespace {
namespace fs = std::filesystem;

// Seen from above, 5 cm cells: a tall box (8), a low one (3), a row of posts (6).
const std::vector<std::string_view> kPlan = {
    "....................", "....................", "....................", "...8888.............",
    "...8888.............", "...8888......6......", "....................", ".............6......",
    "....................", "......3333...6......", "......3333..........", "......3333...6......",
    "....................", ".............6......", "...33...............", "...33...............",
    "...........8888.....", "...........8888.....", "....................", "....................",
};

std::vector<Eigen::Vector3f> hits(const RangeScan& scan, const Pose& T_world_sensor) {
  std::vector<Eigen::Vector3f> points;
  for (std::size_t line = 0; line < scan.lines(); ++line) {
    for (std::size_t beam = 0; beam < scan.beams(); ++beam) {
      const float range = scan.range(line, beam);
      if (!std::isfinite(range)) continue;
      const Eigen::Vector3d p_sensor =
          range * beam_direction({scan.azimuth_rad[beam], scan.tilt_rad[line]});
      points.emplace_back((T_world_sensor * p_sensor).cast<float>());
    }
  }
  return points;
}

cv::Mat picture(const OccupancyGrid& grid, const std::vector<Candidate>& views) {
  MapPanelInput input;
  input.grid = &grid;
  for (const Candidate& view : views) input.T_world_candidates.push_back(view.T_world_sensor);
  return draw_map_panel(input, {640, 720});
}

/// Views chosen greedily by one gain in a voxel world: no physics, no noise, so exact.
GoldenResult explore_voxels(const Gain& gain) {
  const VoxelWorld world = voxel_world(kPlan, 0.05, 10);
  OccupancyGrid grid(world.frame);
  ClutterHazard hazard({}, world.frame.cells);
  const FieldOfView field{.half_width_rad = 0.35, .tilt_min_rad = -0.2, .tilt_max_rad = 0.8};
  const RingOfViews ring{
      .positions = 8, .radius_m = 1.1, .height_m = 0.6, .yaw_offsets_rad = {0.0}};
  const auto views = ring_of_views(ring, {0.0, 0.0, 0.25});
  GoldenResult result;
  Rng rng(1);
  std::size_t view = 0;
  for (int step = 0; step < 6; ++step) {
    const Pose& T_world_sensor = views[view].T_world_sensor;
    const RangeScan scan = scan_voxels(world, T_world_sensor, field, 0.01);
    hazard.observe(grid, scan, T_world_sensor);
    add_measurements(grid, hits(scan, T_world_sensor), InverseSensorModel{});
    carve_free_space(grid, scan, T_world_sensor, FreeSpaceUpdate{});
    const auto filled = fill_holes(grid, HoleFilling{});
    const BlockField transmission = hazard.transmission();
    auto candidates = views;
    const auto gains = exact_gains_bits(gain, {filled.grid, &transmission}, candidates, field, 2);
    for (std::size_t i = 0; i < gains.size(); ++i) candidates[i].gain_bits = gains[i];
    result.trace.exact(step, "view", static_cast<double>(view));
    result.trace.exact(step, "unobserved_cells",
                       static_cast<double>(grid.count(CellState::unobserved)));
    result.trace.exact(step, "occupied_cells",
                       static_cast<double>(grid.count(CellState::occupied)));
    result.trace.exact(step, "filled_cells", static_cast<double>(filled.filled_cells));
    view = choose_view(GreedyGain{}, candidates, rng);
    result.trace.exact(step, "next_gain_bits", std::round(10.0 * gains[view]) / 10.0);
  }
  result.image = picture(grid, views);
  return result;
}

double rounded(double value, double per_unit) { return std::round(per_unit * value) / per_unit; }

/// A short real episode: physics, noise, registration. The same bits on every machine, so exact.
GoldenResult run_episode_file(const std::string& name) {
  const fs::path golden = fs::path(VANTAGE_SOURCE_DIR) / "tests" / "golden" / name;
  const fs::path out =
      fs::temp_directory_path() / fmt::format("vantage-golden-{}-{}", name, ::getpid());
  set_verbosity(Verbosity::quiet);
  const ResolvedEpisode resolved = load_episode(golden / "episode.yaml", {});
  const auto metrics = nlohmann::json::parse(run(resolved, {out, true, false, {}}).metrics);
  GoldenResult result;
  int step = 0;
  for (const auto& scan : metrics["scans"]) {
    Trace& trace = result.trace;
    trace.exact(step, "chosen_view", scan["chosen_view"]);
    trace.exact(step, "fallback", scan["fallback"].get<bool>() ? 1.0 : 0.0);
    trace.exact(step, "collisions", scan["collisions"]);
    trace.exact(step, "unobserved_cells", scan["unobserved_cells"]);
    trace.exact(step, "observable_unobserved_cells", scan["observable_unobserved_cells"]);
    for (const auto& [gain, cells] : scan["predicted"].items()) {
      trace.exact(step, "predicted." + gain, std::round(cells.get<double>()));
    }
    trace.exact(step, "leg_length_m", rounded(scan["leg_length_m"], 1e3));
    trace.exact(step, "pose_error_m", rounded(scan["pose_error_m"], 1e4));
    trace.exact(step, "precision", rounded(scan["precision"], 1e3));
    ++step;
  }
  OccupancyGrid grid(std::get<Tabletop>(resolved.task).map.frame());
  for (const auto& p : read_octomap(out / "map.bt").occupied_centres) {
    const auto cell = grid.frame.cell_at(p.cast<double>());
    if (grid.frame.contains(cell)) grid.log_odds[grid.frame.index(cell)] = 4.0F;
  }
  result.image = picture(grid, {});
  fs::remove_all(out);
  return result;
}

}  // namespace

std::vector<GoldenEpisode> golden_episodes() {
  return {
      {"voxels_simple", [] { return explore_voxels(SimpleGain{}); }},
      {"voxels_posterior_chain", [] { return explore_voxels(PosteriorChainGain{}); }},
      {"voxels_visibility_weighted", [] { return explore_voxels(VisibilityWeightedGain{}); }},
      {"voxels_beer_lambert", [] { return explore_voxels(BeerLambertGain{}); }},
      {"voxels_adaptive", [] { return explore_voxels(AdaptiveGain{}); }},
      {"tabletop_short", [] { return run_episode_file("tabletop_short"); }},
      {"tabletop_blocked", [] { return run_episode_file("tabletop_blocked"); }},
  };
}

}  // namespace vantage
