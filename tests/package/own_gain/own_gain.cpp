// A gain and a choice of your own, in your own program: where to look to complete what is round a
// handle?
#include <cmath>
#include <cstdio>
#include <vector>

#include "vantage/belief/map/octomap_io.hpp"
#include "vantage/planners/choice/view_choice.hpp"
#include "vantage/planners/views/score_views.hpp"
#include "vantage/planners/views/view_candidates.hpp"

using namespace vantage;

// Unobserved cells that a beam reaches, the nearer to the handle the more worth seeing.
struct NearHandle {
  Eigen::Vector3d p_world_m;
  double reach_m = 0.1;
  static constexpr bool unobserved_only = true;
  using Ray = AttenuatedRay;
  CellTables prepare(const GainContext& context) const {
    const GridFrame& frame = context.grid.frame;
    CellTables tables =
        attenuation_tables(context.grid, {.transmission = uniform_field(frame.cells, 0.99)});
    for (std::size_t cell = 0; cell < context.grid.size(); ++cell) {
      const double away_m = (frame.centre(frame.cell(cell)) - p_world_m).norm();
      tables.utility[cell] *= static_cast<float>(std::exp(-away_m / reach_m));
    }
    return tables;
  }
  Ray ray(const CellTables& tables) const { return Ray(tables); }
};

int main(int argc, char** argv) {
  OccupancyGrid unknown(make_grid_frame({0.0, 0.0, 1.0}, {1.0, 1.0, 0.5}, {40, 40, 20}));
  for (std::size_t i = 0; i < unknown.size(); i += 40)
    unknown.log_odds[i] = -4.0F;  // one face seen
  if (argc < 2) write_octomap(unknown, "map.bt");
  const OctomapFile map(argc < 2 ? "map.bt" : argv[1]);

  const NearHandle gain{.p_world_m = {0.4, 0.0, 1.0}};
  const FieldOfView sensor{.half_width_rad = 0.5, .tilt_min_rad = -0.4, .tilt_max_rad = 0.4};
  std::vector<Candidate> views = ring_of_views({.positions = 12}, {0.0, 0.0, 1.0});
  const auto gains = score_views(map, {}, gain, views, sensor, /*threads=*/2);
  for (std::size_t i = 0; i < views.size(); ++i) {
    views[i].gain_bits = gains[i];
    std::printf("view %2d: %.1f\n", views[i].id, gains[i]);
  }
  // A choice is a function: the first view that is worth at least 90 % of the best.
  Rng rng(1);
  const auto good_enough = [](std::span<const Candidate> from, Rng&) {
    const auto best = std::ranges::max(from, {}, &Candidate::gain_bits).gain_bits;
    return static_cast<std::size_t>(
        std::ranges::find_if(from, [&](const Candidate& v) { return v.gain_bits >= 0.9 * best; }) -
        from.begin());
  };
  const Candidate& chosen = views[choose_view(good_enough, views, rng)];
  std::printf("look from view %d\n", chosen.id);
  return chosen.T_world_sensor.translation().x() > 0.5 ? 0 : 1;  // the side of the handle
}
