#include "vantage/planners/trajectory/flight_hazards.hpp"

#include "vantage/planners/trajectory/observation_ring.hpp"

namespace vantage {
namespace {

/// Beside the given path, places need not have been seen.
constexpr double kTrusted_m = 0.75;

}  // namespace

std::vector<std::uint8_t> flight_hazards(const FlightMap& map, const Eigen::Matrix4Xd& given) {
  std::vector<std::uint8_t> cells = map.obstacles();
  const std::vector<std::uint8_t> unseen = map.unseen_places();
  const GridFrame& frame = map.grid().frame;
  const auto layer =
      static_cast<std::size_t>(frame.cells.x()) * static_cast<std::size_t>(frame.cells.y());
  const Eigen::Matrix4Xd level = levelled(given);
  for (std::size_t place = 0; place < layer; ++place) {
    if (unseen[place] == 0) continue;
    const Eigen::Vector3d p_m = levelled(frame.centre(frame.cell(place)));
    if (nearest_on_path(level, p_m).distance_m <= kTrusted_m) continue;
    for (std::size_t cell = place; cell < cells.size(); cell += layer) cells[cell] = 1;
  }
  return cells;
}

}  // namespace vantage
