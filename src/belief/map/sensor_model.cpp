#include "vantage/belief/map/sensor_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace vantage {
namespace {

/// sigma_axis >= 0.65 h gives d^2 <= 3 (0.5 / 0.65)^2 = 1.78 at a cell's corner, where the default
/// peak leaves p(m|z) = 0.62.
constexpr double kSigmaPerCell = 0.65;
/// Where spread evidence stops: p(o) = 0.59.
constexpr float kSpreadLimit = 0.363965F;

/// What one scan says about each cell.
struct ScanEvidence {
  explicit ScanEvidence(std::size_t cells)
      : d2(cells, std::numeric_limits<float>::infinity()), hit(cells, false) {}
  std::vector<float> d2;             ///< to the nearest point
  std::vector<bool> hit;             ///< a point lies in the cell
  std::vector<std::size_t> touched;  ///< cells with finite d2, each once
};

template <class Visit>
void for_each_cell(const GridFrame& frame, const Eigen::Array3i& low, const Eigen::Array3i& high,
                   Visit&& visit) {
  const Eigen::Array3i first = low.max(0);
  const Eigen::Array3i last = high.min(frame.cells - 1);
  for (int z = first.z(); z <= last.z(); ++z) {
    for (int y = first.y(); y <= last.y(); ++y) {
      for (int x = first.x(); x <= last.x(); ++x) visit(Eigen::Array3i(x, y, z));
    }
  }
}

void spread_point(const GridFrame& frame, const Eigen::Vector3d& p_world,
                  const Eigen::Array3d& sigma_m, double spread_sigmas, ScanEvidence& evidence) {
  const Eigen::Array3i home = frame.cell_at(p_world);
  const auto home_index = frame.contains(home) ? frame.index(home) : frame.size();
  if (home_index < frame.size()) evidence.hit[home_index] = true;
  const Eigen::Vector3d reach = spread_sigmas * sigma_m;
  const Eigen::Array3i low = frame.cell_at(p_world - reach).min(home);
  const Eigen::Array3i high = frame.cell_at(p_world + reach).max(home);
  const double d2_limit = spread_sigmas * spread_sigmas;
  for_each_cell(frame, low, high, [&](const Eigen::Array3i& cell) {
    const double d2 = ((frame.centre(cell) - p_world).array() / sigma_m).square().sum();
    const std::size_t index = frame.index(cell);
    if (d2 > d2_limit && index != home_index) return;
    float& best = evidence.d2[index];
    if (std::isinf(best)) evidence.touched.push_back(index);
    best = std::min(best, static_cast<float>(d2));
  });
}

ScanEvidence collect(const GridFrame& frame, std::span<const Eigen::Vector3f> p_world,
                     const InverseSensorModel& model) {
  ScanEvidence evidence(frame.size());
  const Eigen::Array3d sigma_m = (kSigmaPerCell * frame.cell_size_m).array().max(model.sigma_m);
  Eigen::AlignedBox3d near = frame.box();
  near.min() -= (model.spread_sigmas * sigma_m).matrix();
  near.max() += (model.spread_sigmas * sigma_m).matrix();
  for (const Eigen::Vector3f& point : p_world) {
    const Eigen::Vector3d p = point.cast<double>();
    // NaN compares false, so a point that is not finite is outside.
    if (near.contains(p)) spread_point(frame, p, sigma_m, model.spread_sigmas, evidence);
  }
  return evidence;
}

/// Bayes in log odds, l <- l + logit p(m|z), up to the limit of what evidence of its kind may do.
float updated(float log_odds, float evidence, bool hit, float limit) {
  const CellState state = classify(log_odds);
  if (!hit && state == CellState::free) return log_odds;
  if (!hit && state == CellState::unobserved) limit = kSpreadLimit;
  return std::max(log_odds, std::min(log_odds + evidence, limit));
}

}  // namespace

void add_measurements(OccupancyGrid& grid, std::span<const Eigen::Vector3f> p_world,
                      const InverseSensorModel& model) {
  check_options(model, "inverse sensor model");
  const ScanEvidence scan = collect(grid.frame, p_world, model);
  const auto limit = static_cast<float>(model.max_abs_log_odds);
  for (const std::size_t cell : scan.touched) {
    const double p = 0.5 + (model.p_occupied_peak - 0.5) * std::exp(-0.5 * scan.d2[cell]);
    float& log_odds = grid.log_odds[cell];
    log_odds = updated(log_odds, static_cast<float>(log_odds_of(p)), scan.hit[cell], limit);
  }
}

}  // namespace vantage
