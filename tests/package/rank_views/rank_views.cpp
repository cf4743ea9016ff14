// Where should the sensor look next? Ranks views of a half-known box by their expected gain.
#include <algorithm>
#include <cstdio>
#include <functional>
#include <vector>

#include "vantage/belief/map/octomap_io.hpp"
#include "vantage/planners/swept_gain.hpp"
#include "vantage/planners/views/view_candidates.hpp"

using namespace vantage;

// 1 m x 1 m x 0.5 m: free at x > -0.2 m, a wall there, nothing known behind it.
OccupancyGrid half_known_map() {
  OccupancyGrid map(make_grid_frame({0.0, 0.0, 1.0}, {1.0, 1.0, 0.5}, {40, 40, 20}));
  for (std::size_t cell = 0; cell < map.size(); ++cell) {
    const int x = map.frame.cell(cell).x();
    if (x > 12) map.log_odds[cell] = -4.0F;
    if (x == 12) map.log_odds[cell] = 4.0F;
  }
  return map;
}

int main() {
  const OccupancyGrid map = half_known_map();  // or of a robot: read_octomap_grid("map.bt")
  const Gain gain = BeerLambertGain{.a = 0.99};
  const FieldOfView sensor{.half_width_rad = 0.5, .tilt_min_rad = -0.4, .tilt_max_rad = 0.4};
  std::vector<Candidate> views = ring_of_views({.positions = 12}, map.frame.box().center());

  const std::vector<double> gains_bits = view_gains_bits(gain, {map}, views, sensor, /*threads=*/2);
  for (std::size_t i = 0; i < views.size(); ++i) views[i].gain_bits = gains_bits[i];
  std::ranges::sort(views, std::ranges::greater{}, &Candidate::gain_bits);

  for (const Candidate& view : views) {
    const Eigen::Vector3d p_m = view.T_world_sensor.translation();
    std::printf("view %2d at (%+.2f, %+.2f) m: %5.0f bits\n", view.id, p_m.x(), p_m.y(),
                view.gain_bits);
  }
  write_octomap(map, "half_known.bt");  // for octovis, or `vantage score-views`
  // The best view looks behind the wall, the worst only at it.
  const bool behind = views.front().T_world_sensor.translation().x() < -0.2;
  return behind && views.back().gain_bits < 0.1 * views.front().gain_bits ? 0 : 1;
}
