#include "vantage/sim/sensors/laser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

namespace vantage {
namespace {

/// As many beams as fit into the sector, symmetric about 0.
std::vector<double> beam_azimuths(double sector_rad, double step_rad) {
  const auto gaps = static_cast<int>(std::floor(sector_rad / step_rad + 1e-9));
  std::vector<double> azimuth_rad;
  for (int i = 0; i <= gaps; ++i) azimuth_rad.push_back((i - 0.5 * gaps) * step_rad);
  return azimuth_rad;
}

struct RangeLimits {
  double min_m;
  double max_m;
  double noise_sigma_m;
};

float measure(const RayHit& hit, const RangeLimits& limits, Rng& rng) {
  if (!hit.hit()) return std::numeric_limits<float>::infinity();
  const double range_m = rng.normal(hit.distance_m, limits.noise_sigma_m);
  if (range_m < limits.min_m) return std::numeric_limits<float>::quiet_NaN();
  if (range_m > limits.max_m) return std::numeric_limits<float>::infinity();
  return static_cast<float>(range_m);
}

std::vector<float> measure_line(const RayScene& scene, const Pose& T_world_sensor,
                                const std::vector<double>& azimuth_rad, int sensor_body,
                                const RangeLimits& limits, Rng& rng) {
  std::vector<float> range_m;
  range_m.reserve(azimuth_rad.size());
  for (const double azimuth : azimuth_rad) {
    const Eigen::Vector3d direction =
        T_world_sensor.linear() * Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), 0.0);
    range_m.push_back(measure(
        scene.cast(T_world_sensor.translation(), direction.normalized(), limits.max_m, sensor_body),
        limits, rng));
  }
  return range_m;
}

constexpr double kMaxBeams = 1e7;

void check_ranges(double range_min_m, double range_max_m, double step_rad, double sector_rad) {
  if (range_min_m >= range_max_m) throw ConfigError("range_min_m must be below range_max_m");
  if (step_rad > sector_rad) throw ConfigError("step_rad must not exceed sector_rad");
}

/// Memory ends somewhere: says so before it does.
void check_beams(double beams, std::string_view keys) {
  if (beams <= kMaxBeams) return;
  throw ConfigError(fmt::format("{} make {:.3g} beams a scan, more than 10^7", keys, beams));
}

}  // namespace

void LaserOptions::check() const {
  if (tilt_min_rad >= tilt_max_rad) throw ConfigError("tilt_min_rad must be below tilt_max_rad");
  check_ranges(range_min_m, range_max_m, step_rad, sector_rad);
  check_beams(sector_rad / step_rad * scan_duration_s * line_rate_hz,
              "sector_rad, step_rad, scan_duration_s and line_rate_hz");
}

void PlanarScannerOptions::check() const {
  check_ranges(range_min_m, range_max_m, step_rad, sector_rad);
  check_beams(sector_rad / step_rad, "sector_rad and step_rad");
}

FieldOfView field_of_view(const LaserOptions& options) {
  return {.half_width_rad = beam_azimuths(options.sector_rad, options.step_rad).back(),
          .tilt_min_rad = options.tilt_min_rad,
          .tilt_max_rad = options.tilt_max_rad,
          .range_min_m = options.range_min_m,
          .range_max_m = options.range_max_m};
}

ScanBuilder::ScanBuilder(const LaserOptions& options) : options_(options) {
  check_options(options, "laser");
  azimuth_rad_ = beam_azimuths(options.sector_rad, options.step_rad);
}

void ScanBuilder::add_line(const RayScene& scene, const Pose& T_world_laser,
                           double measured_tilt_rad, int sensor_body, Rng& rng,
                           const std::function<void(std::vector<float>&)>& spoil) {
  const RangeLimits limits{options_.range_min_m, options_.range_max_m, options_.noise_sigma_m};
  lines_.push_back({measured_tilt_rad,
                    measure_line(scene, T_world_laser, azimuth_rad_, sensor_body, limits, rng)});
  if (spoil) spoil(lines_.back().range_m);
}

RangeScan ScanBuilder::finish() {
  constexpr double same_tilt_rad = 1e-6;
  std::ranges::stable_sort(lines_, {}, &Line::tilt_rad);
  RangeScan scan{.tilt_rad = {},
                 .azimuth_rad = azimuth_rad_,
                 .range_m = {},
                 .field_of_view = field_of_view(options_)};
  for (const Line& line : lines_) {
    if (!scan.tilt_rad.empty() && line.tilt_rad - scan.tilt_rad.back() < same_tilt_rad) continue;
    scan.tilt_rad.push_back(line.tilt_rad);
    scan.range_m.insert(scan.range_m.end(), line.range_m.begin(), line.range_m.end());
  }
  lines_.clear();
  return scan;
}

PlanarScan planar_scan(const RayScene& scene, const Pose& T_world_scanner,
                       const Pose2& T_base_scanner, int sensor_body,
                       const PlanarScannerOptions& options, Rng& rng) {
  const RangeLimits limits{options.range_min_m, options.range_max_m, options.noise_sigma_m};
  PlanarScan scan{.T_base_sensor = T_base_scanner,
                  .azimuth_rad = beam_azimuths(options.sector_rad, options.step_rad),
                  .range_m = {},
                  .range_max_m = options.range_max_m};
  scan.range_m = measure_line(scene, T_world_scanner, scan.azimuth_rad, sensor_body, limits, rng);
  return scan;
}

}  // namespace vantage
