// The gains that go by known surfaces and by the border of free space, by known answers and by
// brute force in random worlds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/planners/gains/gain_along.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/information/discrete.hpp"
#include "vantage/planners/views/frontiers.hpp"

namespace vantage {
namespace {

constexpr double kSurfaceTolerance = 1e-5;  // tables are single precision

TEST(ProximityCountGain, CountsDownFromTheSurface) {
  const ProximityCountGain gain{.d_max_cells = 4};
  EXPECT_EQ(along(gain, "..?????#??"), 3.0 + 2.0 + 1.0);
  EXPECT_EQ(along(gain, "?.?#"), 3.0) << "free space ends the way from the surface";
  EXPECT_EQ(along(gain, "??????"), 0.0) << "no surface is known";
  EXPECT_EQ(along(gain, "....#???"), 0.0) << "hidden";
}

// Round a corner: two steps, though nearer as the crow flies.
TEST(StepsFromSurface, GoThroughUnobservedCellsAlone) {
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.0}, {3.0, 2.0, 1.0}, {3, 2, 1}));
  grid.log_odds[0] = 4.0F;   // # . ?
  grid.log_odds[1] = -4.0F;  // ? ? ?
  EXPECT_EQ(steps_from_surface(grid, 9), (std::vector<int>{0, 0, 4, 1, 2, 3}));
  EXPECT_EQ(steps_from_surface(grid, 2), (std::vector<int>{0, 0, 0, 1, 2, 0}));
}

TEST(AverageEntropyGain, IsAMeanOverBeamsThatEndOccupied) {
  EXPECT_NEAR(along(AverageEntropyGain{}, "..???#??"),
              (2.0 * kFreeBits + 3.0 + kOccupiedBits) / 6.0, kSurfaceTolerance);
  EXPECT_EQ(along(AverageEntropyGain{}, "..????"), 0.0);
  OccupancyGrid at_once = row_of_cells("#??");
  at_once.log_odds[0] = static_cast<float>(log_odds_of(0.8));
  EXPECT_NEAR(along(AverageEntropyGain{}, at_once), binary_entropy_bits(0.8), kSurfaceTolerance);
}

/// Beams into two rows of cells, `left` and `right` of the sensor, one beam each.
double of_two_rows(const Gain& gain, const std::string& left, const std::string& right) {
  GridFrame frame;
  frame.min_corner_m = {0.0, -1.0, -0.5};
  frame.cells = {static_cast<int>(left.size()), 2, 1};
  OccupancyGrid grid(frame);
  const std::string cells = right + left;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    grid.log_odds[i] = static_cast<float>(log_odds_of(p_occupied_of(cells[i])));
  }
  const FieldOfView fov{
      .half_width_rad = 0.04, .tilt_min_rad = -0.001, .tilt_max_rad = 0.001, .range_max_m = 1000.0};
  return exact_gain_bits(gain, {grid}, make_pose({-1.0, 0.0, 0.0}, 0.0), fov);
}

/// No beam knows of the one before it, the right one.
template <class G>
void expect_sum_of_two(const std::string& left, const std::string& right) {
  G gain;
  gain.fan.step_rad = 0.05;
  EXPECT_NEAR(of_two_rows(gain, left, right), along(gain, left) + along(gain, right),
              kSurfaceTolerance)
      << G::name << ' ' << left << ' ' << right;
}

TEST(SumOfBeams, IsOfWhatEachIsWorthAlone) {
  struct Rows {
    std::string left, right;
  };
  for (const auto& [left, right] :
       {Rows{"?.?#", "??.."}, Rows{"....", "??#?"}, Rows{"#...", "????"}, Rows{"??#.", "?.??"}}) {
    expect_sum_of_two<OcclusionAwareGain>(left, right);
    expect_sum_of_two<UnobservedVoxelGain>(left, right);
    expect_sum_of_two<RearSideVoxelGain>(left, right);
    expect_sum_of_two<RearSideEntropyGain>(left, right);
    expect_sum_of_two<FsmiGain>(left, right);
  }
}

TEST(AverageEntropyGain, WeighsCellsAlikeNotBeams) {
  AverageEntropyGain gain;
  gain.fan.step_rad = 0.05;
  EXPECT_NEAR(of_two_rows(gain, "???#", "#..."), (3.0 + 2.0 * kOccupiedBits) / 5.0,
              kSurfaceTolerance);
  EXPECT_NEAR(of_two_rows(gain, "???#", "????"), (3.0 + kOccupiedBits) / 4.0, kSurfaceTolerance);
}

TEST(AreaFactor, IsSmoothFromNothingAtTheEndsToOneAtTheTarget) {
  for (const double a : {0.2, 0.5, 0.8}) {
    EXPECT_EQ(area_factor(0.0, a), 0.0);
    EXPECT_NEAR(area_factor(0.5 * a, a), 0.5, 1e-12);
    EXPECT_NEAR(area_factor(a, a), 1.0, 1e-12);
    EXPECT_NEAR(area_factor(a + 1e-6, a), 1.0, 1e-9);
    EXPECT_NEAR(area_factor(0.5 * (1.0 + a), a), 0.5, 1e-12);
    EXPECT_NEAR(area_factor(1.0, a), 0.0, 1e-12);
  }
}

TEST(AreaFactorGain, SortsBeamsByTheFirstCellThatIsNotFree) {
  AreaFactorGain gain{.target_occupied = 0.5, .target_occplane = 0.25};
  gain.fan.step_rad = 0.05;
  const double half = area_factor(0.5, 0.25);
  EXPECT_NEAR(of_two_rows(gain, "..#?", "..?#"), 1.0 + half, kSurfaceTolerance);
  EXPECT_NEAR(of_two_rows(gain, "..#?", "...."), 1.0, kSurfaceTolerance);
  EXPECT_NEAR(of_two_rows(gain, "..?.", "????"), half, kSurfaceTolerance);
  EXPECT_NEAR(of_two_rows(gain, "??.?", "...."), half, kSurfaceTolerance)
      << "out of the unknown, and in";
  EXPECT_NEAR(of_two_rows(gain, "??.#", "????"), 1.0, kSurfaceTolerance);
  EXPECT_NEAR(of_two_rows(gain, "..##", "..#."), 0.0, kSurfaceTolerance) << "all occupied";
}

TEST(FrontierCellsGain, CountsThoseWithNothingButFreeSpaceInFront) {
  EXPECT_EQ(along(FrontierCellsGain{}, "..??#"), 1.0);
  EXPECT_EQ(along(FrontierCellsGain{}, ".?.?"), 1.0) << "the second lies behind the unknown";
  EXPECT_EQ(along(FrontierCellsGain{}, "....#.?"), 0.0) << "hidden";
  EXPECT_EQ(along(FrontierCellsGain{}, "????"), 0.0);
  EXPECT_EQ(along(FrontierCellsGain{}, "...."), 0.0) << "outside the map nothing is unobserved";
}

/// A third of the cells free, unobserved and occupied, the latter few, in a world that `seed`
/// tells.
OccupancyGrid random_world(std::uint64_t seed) {
  OccupancyGrid grid(make_grid_frame({0.0, 0.0, 0.0}, {2.0, 1.8, 1.4}, {10, 8, 7}));
  Rng rng(seed);
  for (float& log_odds : grid.log_odds) {
    const double u = rng.uniform(0.0, 1.0);
    log_odds = static_cast<float>(u < 0.65 ? -2.0 + u : (u < 0.93 ? u - 0.8 : 2.0 + u));
  }
  return grid;
}

/// The cells of a segment, by all its crossings of cell faces, sorted.
std::vector<std::size_t> cells_between(const GridFrame& grid, const Eigen::Vector3d& from,
                                       const Eigen::Vector3d& to) {
  std::vector<double> crossings{0.0, 1.0};
  for (int axis = 0; axis < 3; ++axis) {
    for (int face = 0; face <= grid.cells[axis]; ++face) {
      const double at = grid.min_corner_m[axis] + face * grid.cell_size_m[axis];
      const double t = (at - from[axis]) / (to[axis] - from[axis]);
      if (t > 0.0 && t < 1.0) crossings.push_back(t);
    }
  }
  std::ranges::sort(crossings);
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
    const double t = 0.5 * (crossings[i] + crossings[i + 1]);
    const Eigen::Array3i cell = grid.cell_at(from + t * (to - from));
    if (grid.contains(cell)) cells.push_back(grid.index(cell));
  }
  return cells;
}

struct DrawnView {
  OccupancyGrid grid;
  Pose T_world_sensor;
  FieldOfView fov;

  explicit DrawnView(std::uint64_t seed) : grid(random_world(seed)) {
    Rng rng(seed + 1000);
    const bool inside = seed % 2 == 0;
    const Eigen::Vector3d p_m(rng.uniform(-0.9, 0.9) - (inside ? 0.0 : 2.0), rng.uniform(-0.8, 0.8),
                              rng.uniform(-0.6, 0.6));
    T_world_sensor = make_pose(p_m, rng.uniform(-0.4, 0.4));
    fov = {.half_width_rad = 0.6,
           .tilt_min_rad = -0.35,
           .tilt_max_rad = 0.45,
           .range_min_m = 0.03,
           .range_max_m = 2.6};
  }
  /// For each beam of the fan the cells up to the first occupied one, this included.
  [[nodiscard]] std::vector<std::vector<std::size_t>> beams(const BeamFan& fan) const {
    std::vector<std::vector<std::size_t>> all;
    const Eigen::Vector3d p = T_world_sensor.translation();
    for (const Eigen::Vector3d& direction : beam_directions(fov, fan)) {
      const Eigen::Vector3d d = T_world_sensor.linear() * direction;
      auto cells = cells_between(grid.frame, p + fov.range_min_m * d, p + fov.range_max_m * d);
      const auto wall = std::ranges::find(cells, CellState::occupied,
                                          [this](std::size_t cell) { return grid.state(cell); });
      if (wall != cells.end()) cells.erase(wall + 1, cells.end());
      all.push_back(std::move(cells));
    }
    return all;
  }
  [[nodiscard]] double gain(const Gain& gain) const {
    return exact_gain_bits(gain, {grid}, T_world_sensor, fov);
  }
};

/// Steps by relaxation over pairs of neighbours until nothing changes.
std::vector<int> steps_by_relaxation(const OccupancyGrid& grid) {
  constexpr int kFar = 1 << 20;
  std::vector<int> steps(grid.size(), kFar);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t a = 0; a < grid.size(); ++a) {
      if (grid.state(a) != CellState::unobserved) continue;
      for (std::size_t b = 0; b < grid.size(); ++b) {
        if ((grid.frame.cell(a) - grid.frame.cell(b)).abs().sum() != 1) continue;
        const int from = grid.state(b) == CellState::occupied ? 0 : steps[b];
        if (from + 1 < steps[a]) {
          steps[a] = from + 1;
          changed = true;
        }
      }
    }
  }
  return steps;
}

constexpr std::uint64_t kWorlds = 12;
constexpr BeamFan kFan{.step_rad = 0.13};

TEST(ProximityCountGain, IsThatOfBruteForce) {
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < kWorlds; ++seed) {
    const DrawnView view(seed);
    const auto steps = steps_by_relaxation(view.grid);
    double expected = 0.0;
    for (const auto& beam : view.beams(kFan)) {
      for (const std::size_t cell : beam) expected += std::max(0, 3 - steps[cell]);
    }
    EXPECT_NEAR(view.gain(ProximityCountGain{.fan = kFan, .d_max_cells = 3}), expected,
                kSurfaceTolerance);
    sum += expected;
  }
  EXPECT_GT(sum, 100.0);
}

TEST(AverageEntropyGain, IsThatOfBruteForce) {
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < kWorlds; ++seed) {
    const DrawnView view(seed);
    double bits = 0.0;
    double cells = 0.0;
    for (const auto& beam : view.beams(kFan)) {
      if (beam.empty() || view.grid.state(beam.back()) != CellState::occupied) continue;
      for (const std::size_t cell : beam) bits += binary_entropy_bits(view.grid.p_occupied(cell));
      cells += static_cast<double>(beam.size());
    }
    const double expected = cells > 0.0 ? bits / cells : 0.0;
    EXPECT_NEAR(view.gain(AverageEntropyGain{.fan = kFan}), expected, kSurfaceTolerance) << seed;
    sum += expected;
  }
  EXPECT_GT(sum, 3.0);
}

TEST(AreaFactorGain, IsThatOfBruteForce) {
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < kWorlds; ++seed) {
    const DrawnView view(seed);
    const auto beams = view.beams(kFan);
    double occupied = 0.0;
    double occplane = 0.0;
    for (const auto& beam : beams) {
      std::string states;
      for (const std::size_t cell : beam) {
        states += "f?#"[static_cast<std::size_t>(view.grid.state(cell))];
      }
      states.erase(0, states.find_first_not_of('?'));
      const std::size_t end = states.find_first_not_of('f');
      if (end == std::string::npos) continue;
      (states[end] == '#' ? occupied : occplane) += 1.0 / static_cast<double>(beams.size());
    }
    const double expected = area_factor(occupied, 0.2) + area_factor(occplane, 0.8);
    EXPECT_NEAR(view.gain(AreaFactorGain{.fan = kFan}), expected, kSurfaceTolerance) << seed;
    sum += expected;
  }
  EXPECT_GT(sum, 6.0);
}

TEST(FrontierCellsGain, IsThatOfBruteForce) {
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < kWorlds; ++seed) {
    const DrawnView view(seed);
    const Eigen::Vector3d p = view.T_world_sensor.translation();
    double expected = 0.0;
    for (const std::size_t cell : frontier_cells(view.grid, {})) {
      const Eigen::Vector3d to = view.grid.frame.centre(view.grid.frame.cell(cell));
      if (!view.fov.contains(view.T_world_sensor.inverse() * to)) continue;
      const auto way = cells_between(view.grid.frame, p, to);
      if (std::ranges::all_of(way, [&](auto c) { return view.grid.state(c) == CellState::free; }))
        expected += 1.0;
    }
    EXPECT_EQ(view.gain(FrontierCellsGain{}), expected) << seed;
    sum += expected;
  }
  EXPECT_GT(sum, 40.0);
}

}  // namespace
}  // namespace vantage
