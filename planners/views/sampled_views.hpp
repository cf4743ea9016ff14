/// Views proposed where a map is free, for robots that bring none.
#pragma once

#include <Eigen/Geometry>

#include <numbers>
#include <optional>
#include <vector>

#include "vantage/belief/map/octomap_file.hpp"
#include "vantage/core/fields.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/planners/candidate.hpp"

namespace vantage {

struct SampledViews {
  int positions = 30;
  int headings = 8;
  std::optional<double> height_m = {};
  double clearance_m = 0.2;
  double pitch_rad = 0.0;
  void fields(auto&& f) {
    f("positions", positions, "number of positions that are sampled; more take longer to score",
      between(1, 1000));
    f("headings", headings,
      "number of views at each position, evenly spaced in yaw; more aim better and take longer",
      between(1, 20));
    f("height_m", height_m, "world z of the sensor; null: any height that is free",
      between(-1e6, 1e6));
    f("clearance_m", clearance_m,
      "least distance of a position from every known occupied cell; higher keeps clear of "
      "obstacles",
      between(0.0, 1e6));
    f("pitch_rad", pitch_rad, "pitch of every view; positive looks down",
      between(-std::numbers::pi / 2.0, std::numbers::pi / 2.0));
  }
};

/// Sensor poses (x forward, z up; world frame) in free cells of the map inside `within_m`, spread
/// out: of ten times as many places drawn evenly, each taken lies farthest from those before it.
/// Ids count up place by place. Fewer places if fewer have the clearance. The effort is that of
/// reading the map a few times, whatever its extent.
/// @throws ConfigError if the options are out of range, InputError naming the map if no place will
/// do.
std::vector<Candidate> sample_views(const SampledViews& options, const OctomapFile& map,
                                    const Eigen::AlignedBox3d& within_m, Rng& rng);

}  // namespace vantage
