// Ranks views of a half-known region: three quarters are free, what is left is behind a wall.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "vantage/belief/map/octomap_io.hpp"
#include "vantage/planners/choice/view_choice.hpp"
#include "vantage/planners/exact_gain.hpp"
#include "vantage/planners/views/score_views.hpp"
#include "vantage/planners/views/view_candidates.hpp"

int main() {
  using namespace vantage;
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 1.0}, {1.0, 1.0, 0.5}, {32, 32, 16}));
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    const int x = grid.frame.cell(cell).x();
    if (x > 8) grid.log_odds[cell] = -4.0F;  // free
    if (x == 8) grid.log_odds[cell] = 4.0F;  // a wall; behind it, nothing is known
  }
  std::vector<Candidate> views = ring_of_views(RingOfViews{}, {0.0, 0.0, 1.0});
  const GainContext context{grid, {}};
  const auto gains = exact_gains_bits(SimpleGain{}, context, views, FieldOfView{}, 2);
  for (std::size_t i = 0; i < views.size(); ++i) views[i].gain_bits = gains[i];
  Rng rng(1);
  const auto best = choose_view(GreedyGain{}, views, rng);
  std::ranges::sort(views, std::ranges::greater{}, &Candidate::gain_bits);
  for (const Candidate& view : views) {
    std::printf("view %2d at (%+.2f, %+.2f): %7.0f bits\n", view.id,
                view.T_world_sensor.translation().x(), view.T_world_sensor.translation().y(),
                view.gain_bits);
  }
  // The same from an OctoMap file; its cells are those of the grid, its region is the grid's box.
  write_octomap(grid, "rank_views.bt");
  const ScoredRegion region{.min_m = {{-0.5, -0.5, 0.75}}, .max_m = {{0.5, 0.5, 1.25}}};
  const auto scores = score_views(OctomapFile("rank_views.bt"), region, SimpleGain{}, views, {}, 2);
  const bool agree = std::ranges::max_element(scores) == scores.begin() &&
                     std::abs(scores.front() - views.front().gain_bits) < 0.05 * scores.front();
  // The unknown lies at negative x: the best view must stand on that side, the worst sees the wall.
  const bool right = views.front().T_world_sensor.translation().x() < 0.0 &&
                     views.back().gain_bits < 0.1 * views.front().gain_bits && gains[best] > 0.0 &&
                     agree;
  return right ? 0 : 1;
}
