#include "vantage/planners/views/score_views.hpp"

#include <fmt/format.h>

#include <variant>

namespace vantage {
namespace {

/// Views next to each other in the list, and the cells they reach together.
struct Batch {
  CellBlock reach;
  std::vector<Candidate> views;
  std::vector<std::size_t> places;  ///< of the views in the list
};

/// What is read of a map for views: cells of the grid, whole but where the region cuts them.
struct Reach {
  const OctomapFile& map;
  const ScoredRegion& region;
  const FieldOfView& sensor;
  int halo_cells;
  CellBlock inside = region.cells(map);

  [[nodiscard]] CellBlock of(const Candidate& view) const {
    const Eigen::Vector3d p_sensor = view.T_world_sensor.translation();
    const Eigen::Vector3d range_m = Eigen::Vector3d::Constant(sensor.range_max_m);
    const CellBlock seen =
        map.cells_in({p_sensor - range_m, p_sensor + range_m}).coarsened(region.coarsen);
    return CellBlock{(seen.begin - halo_cells) * region.coarsen,
                     (seen.end + halo_cells) * region.coarsen}
        .cut(inside);
  }
  [[nodiscard]] bool fits(const CellBlock& reach) const {
    return reach.coarsened(region.coarsen).count() <= kMaxScoredCells;
  }
  void require_fit(const CellBlock& reach, const Candidate& view) const {
    if (fits(reach)) return;
    const CellBlock coarse = reach.coarsened(region.coarsen);
    const Eigen::Array3i cells = coarse.end - coarse.begin;
    throw InputError(fmt::format(
        "{}: view {} reaches over {} x {} x {} cells of {} m{}, more than 2^25: lower "
        "sensor.range_max_m, narrow region.min_m and region.max_m, or raise region.coarsen",
        map.name(), view.id, cells.x(), cells.y(), cells.z(), region.cell_m(map),
        halo_cells > 1 ? fmt::format(", {} on each side for the gain alone", halo_cells) : ""));
  }
};

/// As few batches as fit, so that views that overlap share their tables.
std::vector<Batch> batches_of(const Reach& reach_of, std::span<const Candidate> views) {
  std::vector<Batch> batches;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const CellBlock reach = reach_of.of(views[i]);
    if (reach.empty()) continue;
    reach_of.require_fit(reach, views[i]);
    if (batches.empty() || !reach_of.fits(batches.back().reach.joined(reach))) {
      batches.emplace_back();
    }
    Batch& batch = batches.back();
    batch.reach = batch.reach.joined(reach);
    batch.views.push_back(views[i]);
    batch.places.push_back(i);
  }
  return batches;
}

}  // namespace

CellBlock ScoredRegion::cells(const OctomapFile& map) const {
  Eigen::AlignedBox3d box_m = map.box_of(map.known());
  if (min_m) box_m.min() = Eigen::Vector3d::Map(min_m->data());
  if (max_m) box_m.max() = Eigen::Vector3d::Map(max_m->data());
  return map.cells_in(box_m);
}

std::vector<double> score_views(const OctomapFile& map, const ScoredRegion& region,
                                const GridGains& gains_on, std::span<const Candidate> views,
                                const FieldOfView& sensor, int halo_cells) {
  check_options(sensor, "sensor");
  check_options(region, "region");
  std::vector<double> gains(views.size(), 0.0);
  for (const Batch& batch : batches_of({map, region, sensor, halo_cells}, views)) {
    const auto found = gains_on(map.grid_of(batch.reach, region.coarsen), batch.views);
    for (std::size_t i = 0; i < found.size(); ++i) gains[batch.places[i]] = found[i];
  }
  return gains;
}

std::vector<double> score_views(const OctomapFile& map, const ScoredRegion& region,
                                const Gain& gain, std::span<const Candidate> views,
                                const FieldOfView& sensor, int threads) {
  expects(!std::holds_alternative<AdaptiveGain>(gain), "a gain that needs no run");
  return std::visit(
      [&](const auto& g) { return score_views(map, region, g, views, sensor, threads); }, gain);
}

}  // namespace vantage
