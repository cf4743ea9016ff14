// A gain and a choice of your own: from where to look to complete what is round a handle?
#include <cstdio>

#include "vantage/belief/map/octomap_io.hpp"
#include "vantage/planners/choice/view_choice.hpp"
#include "vantage/planners/views/score_views.hpp"
#include "vantage/planners/views/view_candidates.hpp"

using namespace vantage;

// Unobserved cells that a beam reaches, within a hand's breadth of the handle.
struct NearHandle {
  Eigen::Vector3d p_world_m;
  static constexpr bool unobserved_only = true;
  using Ray = AttenuatedRay;
  CellTables prepare(const GainContext& context) const {
    const GridFrame& frame = context.grid.frame;
    const auto transmission = uniform_field(frame.cells, 0.99);  // of an unobserved cell
    CellTables tables = attenuation_tables(context.grid, {.transmission = transmission});
    for (std::size_t cell = 0; cell < context.grid.size(); ++cell) {
      const double away_m = (frame.centre(frame.cell(cell)) - p_world_m).norm();
      if (away_m > 0.1) tables.utility[cell] = 0.0F;
    }
    return tables;
  }
  Ray ray(const CellTables& tables) const { return Ray(tables); }
};

// The first view that is worth at least nine tenths of the best.
std::size_t good_enough(std::span<const Candidate> views, Rng&) {
  const double best = std::ranges::max(views, {}, &Candidate::gain_bits).gain_bits;
  std::size_t i = 0;
  while (views[i].gain_bits < 0.9 * best) ++i;
  return i;
}

int main() {
  // A block of 1 m x 1 m x 0.5 m that nobody has looked into. Of a robot's map:
  // OctomapFile("map.bt")
  OccupancyGrid block(make_grid_frame({0.0, 0.0, 1.0}, {1.0, 1.0, 0.5}, {40, 40, 20}));
  for (std::size_t corner : {std::size_t{0}, block.size() - 1}) block.log_odds[corner] = -4.0F;
  write_octomap(block, "block.bt");

  const FieldOfView sensor{.half_width_rad = 0.5, .tilt_min_rad = -0.4, .tilt_max_rad = 0.4};
  std::vector<Candidate> views = ring_of_views({.positions = 12}, {0.0, 0.0, 1.0});
  const NearHandle gain{.p_world_m = {0.4, 0.0, 1.0}};
  const auto gains = score_views(OctomapFile("block.bt"), {}, gain, views, sensor, /*threads=*/2);
  for (std::size_t i = 0; i < views.size(); ++i) views[i].gain_bits = gains[i];

  Rng rng(1);
  const Candidate& chosen = views[choose_view(good_enough, views, rng)];
  const Eigen::Vector3d p_m = chosen.T_world_sensor.translation();
  std::printf("view %d at (%.2f, %.2f): %.1f bits\n", chosen.id, p_m.x(), p_m.y(),
              chosen.gain_bits);
  return p_m.x() > 0.5 ? 0 : 1;  // the side of the handle
}
