#include "vantage/tasks/mapping/external/planner_grids.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "vantage/core/error.hpp"

namespace vantage {
namespace {
using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "the files say so");

/// @return the error; 0 if there is none
int write_bytes(int file, std::span<const std::byte> bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t wrote =
        ::pwrite(file, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) return errno;
    done += static_cast<std::size_t>(wrote);
  }
  return ::ftruncate(file, static_cast<off_t>(bytes.size())) == 0 ? 0 : errno;
}

/// The folder is the planner's, and it may do to it what these errors say.
bool is_planners_doing(int error) {
  constexpr auto kErrors =
      std::to_array({ELOOP, EISDIR, ENOTDIR, ENOENT, EACCES, EPERM, ENXIO, ESPIPE});
  return std::ranges::find(kErrors, error) != kErrors.end();
}

/// A link that the planner has put there is not followed, a pipe not waited for.
void write_in_place(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  const int file =
      ::open(path.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0600);
  const int error = file < 0 ? errno : write_bytes(file, bytes);
  if (file >= 0) ::close(file);
  if (error == 0) return;
  const std::string why = fmt::format("{}: cannot write: {}", path.string(), std::strerror(error));
  if (is_planners_doing(error)) throw SpoiltFolder(why);
  throw OutputError(why);
}

template <class T>
Json grid_file(const std::filesystem::path& folder, const char* name, const char* type,
               const std::vector<T>& cells, const Json& where) {
  write_in_place(folder / name, std::as_bytes(std::span(cells)));
  Json json = {{"file", name}, {"dtype", type}, {"order", "x fastest"}};
  json.update(where);
  return json;
}

Json place_of(const FloorMap& floor) {
  return {{"shape", {floor.nx, floor.ny}},
          {"min_corner_m", {floor.min_corner_m.x(), floor.min_corner_m.y()}},
          {"cell_m", {floor.cell_m, floor.cell_m}}};
}

Json place_of(const GridFrame& frame) {
  const auto three = [](const auto& v) { return Json{v.x(), v.y(), v.z()}; };
  return {{"shape", three(frame.cells)},
          {"min_corner_m", three(frame.min_corner_m)},
          {"cell_m", three(frame.cell_size_m)}};
}

std::vector<std::uint8_t> floor_states(const FloorMap& floor) {
  std::vector<std::uint8_t> states(floor.size());
  for (std::size_t cell = 0; cell < states.size(); ++cell) {
    states[cell] = static_cast<std::uint8_t>(floor.state(cell));
  }
  return states;
}

}  // namespace

Json write_planner_grids(const DecisionRequest& request, const std::filesystem::path& folder) {
  const OccupancyGrid& grid = request.situation.grid;
  const PathField& paths = request.paths;
  Json occupancy =
      grid_file(folder, "occupancy.raw", "float32", grid.log_odds, place_of(grid.frame));
  occupancy["free_at_most"] = kFreeLogOdds;
  occupancy["occupied_at_least"] = kOccupiedLogOdds;
  const Json floor_place = place_of(paths.map);
  return {{"occupancy", std::move(occupancy)},
          {"floor", grid_file(folder, "floor.raw", "uint8", floor_states(paths.map), floor_place)},
          {"ways", grid_file(folder, "ways.raw", "float64", paths.cost, floor_place)}};
}

}  // namespace vantage
