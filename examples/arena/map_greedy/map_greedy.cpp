// Greedy by a gain of its own: reads the map that the robot shares as a file, works out what each
// view would show of it, and discounts that by the way.
//
// A planner for `choice: {name: external, command: [path/to/map_greedy]}`, built against the
// installed package. Half of a beam is taken to pass a metre of what nobody has seen.
#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "vantage/planners/swept_gain.hpp"

using namespace vantage;
using Json = nlohmann::json;

constexpr double kPassesPerMetre = 0.5;
constexpr double kDecayPerSecond = 0.01;

// A grid of log odds as a file of the working directory, mapped once: it is written in place.
class SharedMap {
 public:
  OccupancyGrid read(const Json& header) {
    GridFrame frame;
    for (int axis = 0; axis < 3; ++axis) {
      frame.cells[axis] = header["shape"][axis];
      frame.min_corner_m[axis] = header["min_corner_m"][axis];
      frame.cell_size_m[axis] = header["cell_m"][axis];
    }
    OccupancyGrid grid(frame);
    if (cells_ == nullptr) map(header["file"], grid.size() * sizeof(float));
    std::copy_n(cells_, grid.size(), grid.log_odds.begin());
    return grid;
  }

 private:
  void map(const std::string& file, std::size_t bytes) {
    const int opened = ::open(file.c_str(), O_RDONLY);
    void* mapped = ::mmap(nullptr, bytes, PROT_READ, MAP_SHARED, opened, 0);
    ::close(opened);
    if (mapped == MAP_FAILED) throw std::runtime_error("cannot map " + file);
    cells_ = static_cast<const float*>(mapped);
  }
  const float* cells_ = nullptr;
};

Candidate candidate_of(const Json& view) {
  const auto s = view["sensor"].get<std::vector<double>>();  // x, y, z, yaw, pitch
  Candidate candidate;
  candidate.T_world_sensor = Eigen::Translation3d(s[0], s[1], s[2]) *
                             Eigen::AngleAxisd(s[3], Eigen::Vector3d::UnitZ()) *
                             Eigen::AngleAxisd(s[4], Eigen::Vector3d::UnitY());
  return candidate;
}

int decide(const Json& request, SharedMap& shared) {
  const OccupancyGrid map = shared.read(request["grids"]["occupancy"]);
  const Gain gain = BeerLambertGain{.a = std::pow(kPassesPerMetre, map.frame.cell_size_m.mean())};
  const Json& field = request["field_of_view"];
  const FieldOfView sensor{.half_width_rad = field["half_width_rad"],
                           .tilt_min_rad = field["tilt_min_rad"],
                           .tilt_max_rad = field["tilt_max_rad"],
                           .range_min_m = field["range_min_m"],
                           .range_max_m = field["range_max_m"]};
  std::vector<Candidate> views;
  for (const Json& view : request["candidates"]) views.push_back(candidate_of(view));
  const std::vector<double> gains = view_gains_bits(gain, {map}, views, sensor, /*threads=*/1);
  int best = 0;
  double most = -2.0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Json& view = request["candidates"][i];
    const bool open = !view["exhausted"].get<bool>();
    const double worth =
        view["travel_s"].is_null()
            ? -1.0
            : gains[i] * std::exp(-kDecayPerSecond * view["travel_s"].get<double>());
    if (open && worth > most) {
      most = worth;
      best = static_cast<int>(i);
    }
  }
  return best;
}

int main() {
  SharedMap map;
  for (std::string line; std::getline(std::cin, line);) {
    const Json message = Json::parse(line);
    Json answer{{"protocol", "vantage-planner"}, {"version", 1}, {"name", "map greedy"}};
    if (message["type"] == "end") return 0;
    if (message["type"] == "decide") answer = {{"view", decide(message, map)}};
    std::cout << answer << std::endl;
  }
}
