#include "vantage/runtime/log/event_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "vantage/core/bytes.hpp"
#include "vantage/core/error.hpp"

namespace vantage {
namespace {

constexpr std::string_view kMagic = "VANTAGE STORY 1\n";
constexpr std::array<std::size_t, 5> kEntryBytes{12, 14 * sizeof(double), 2 * sizeof(double),
                                                 3 * sizeof(double), 8 * sizeof(double)};

struct PutEntries {
  std::string& bytes;

  void header(std::uint32_t kind, std::size_t count, std::size_t chosen = 0) const {
    put(bytes, kind);
    put(bytes, static_cast<std::uint32_t>(count));
    put(bytes, static_cast<std::uint64_t>(chosen));
  }
  void operator()(const MapChange& change) const {
    header(0, change.runs.size());
    for (const CellRun& run : change.runs) {
      put(bytes, run.first);
      put(bytes, run.count);
      put(bytes, static_cast<std::uint32_t>(run.state));
    }
  }
  void operator()(const Decision& decision) const {
    header(1, decision.candidates.size(), decision.chosen);
    for (const Candidate& view : decision.candidates) {
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
          put(bytes, view.T_world_sensor.matrix()(row, column));
        }
      }
      put(bytes, view.gain_bits);
      put(bytes, view.reachable ? 1.0 : 0.0);
    }
  }
  void operator()(const PlannedRoute& route) const {
    header(2, route.path_m.size());
    for (const Eigen::Vector2d& p : route.path_m) {
      put(bytes, p.x());
      put(bytes, p.y());
    }
  }
  void operator()(const PlannedFlight& flight) const {
    header(3, flight.path_m.size());
    for (const Eigen::Vector3d& p : flight.path_m) {
      for (const double value : p) put(bytes, value);
    }
  }
  void operator()(const PlannedTour& tour) const {
    header(4, tour.stops.size(), static_cast<std::size_t>(tour.reason.change));
    put(bytes, tour.reason.saved_s);
    for (const PlannedStop& stop : tour.stops) {
      for (const double value :
           {static_cast<double>(stop.id), stop.place_m.x(), stop.place_m.y(), stop.yaw_rad,
            stop.arrival_s, stop.departure_s, stop.gain, stop.beyond}) {
        put(bytes, value);
      }
    }
  }
};

Candidate take_candidate(ByteReader& reader, int id, std::string_view what) {
  Candidate view;
  view.id = id;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      view.T_world_sensor.matrix()(row, column) = reader.number<double>(what);
    }
  }
  view.gain_bits = reader.number<double>(what);
  view.reachable = reader.number<double>(what) != 0.0;
  return view;
}

CellRun take_run(ByteReader& reader, std::string_view what) {
  const auto first = reader.number<std::uint32_t>(what);
  const auto cells = reader.number<std::uint32_t>(what);
  const auto state = reader.number<std::uint32_t>(what);
  reader.require(state <= 2, fmt::format("{} sets cells to a state {}", what, state));
  return {first, cells, static_cast<CellState>(state)};
}

Eigen::Vector2d take_point(ByteReader& reader, std::string_view what) {
  const auto x_m = reader.number<double>(what);
  return {x_m, reader.number<double>(what)};
}

PlannedStop take_stop(ByteReader& reader, std::string_view what) {
  constexpr double kMaxId = 1e9;
  PlannedStop stop;
  const auto id = reader.number<double>(what);
  reader.require(id >= -1.0 && id <= kMaxId, fmt::format("{} has a stop of id {}", what, id));
  stop.id = static_cast<int>(id);
  stop.place_m = take_point(reader, what);
  for (double* value :
       {&stop.yaw_rad, &stop.arrival_s, &stop.departure_s, &stop.gain, &stop.beyond}) {
    *value = reader.number<double>(what);
  }
  return stop;
}

PlannedTour take_tour(ByteReader& reader, std::size_t stops, std::uint64_t change,
                      std::string_view what) {
  reader.require(change < kPlanChanges, fmt::format("{} has a change {}", what, change));
  PlannedTour tour;
  tour.reason = {static_cast<PlanChange>(change), reader.number<double>(what)};
  for (std::size_t i = 0; i < stops; ++i) tour.stops.push_back(take_stop(reader, what));
  return tour;
}

EpisodeEvent take_event(ByteReader& reader, std::string_view what) {
  EpisodeEvent event{reader.number<std::uint64_t>(what), {}};
  const auto kind = reader.number<std::uint32_t>(what);
  const auto count = reader.number<std::uint32_t>(what);
  const auto chosen = reader.number<std::uint64_t>(what);
  reader.require(kind < kEntryBytes.size(), fmt::format("{} is of a kind {}", what, kind));
  reader.require_items(count, kEntryBytes[kind], what);
  if (kind == 0) {
    MapChange change;
    for (std::uint32_t i = 0; i < count; ++i) change.runs.push_back(take_run(reader, what));
    event.what = std::move(change);
  } else if (kind == 1) {
    Decision decision{{}, chosen};
    for (std::uint32_t i = 0; i < count; ++i) {
      decision.candidates.push_back(take_candidate(reader, static_cast<int>(i), what));
    }
    event.what = std::move(decision);
  } else if (kind == 2) {
    PlannedRoute route;
    for (std::uint32_t i = 0; i < count; ++i) route.path_m.push_back(take_point(reader, what));
    event.what = std::move(route);
  } else if (kind == 4) {
    event.what = take_tour(reader, count, chosen, what);
  } else {
    PlannedFlight flight;
    for (std::uint32_t i = 0; i < count; ++i) {
      const Eigen::Vector2d level_m = take_point(reader, what);
      flight.path_m.emplace_back(level_m.x(), level_m.y(), reader.number<double>(what));
    }
    event.what = std::move(flight);
  }
  return event;
}

struct Plausible {
  std::size_t cells;

  bool operator()(const MapChange& change) const {
    return std::ranges::all_of(change.runs, [&](const CellRun& run) {
      return static_cast<std::size_t>(run.first) + run.count <= cells;
    });
  }
  bool operator()(const Decision& decision) const {
    return decision.chosen <= decision.candidates.size() &&
           std::ranges::all_of(decision.candidates, [](const Candidate& view) {
             return view.T_world_sensor.matrix().allFinite();
           });
  }
  bool operator()(const PlannedRoute& route) const { return all_finite(route.path_m); }
  bool operator()(const PlannedFlight& flight) const { return all_finite(flight.path_m); }
  bool operator()(const PlannedTour& tour) const {
    return std::ranges::all_of(tour.stops, [](const PlannedStop& stop) {
      return stop.place_m.allFinite() && std::isfinite(stop.yaw_rad) &&
             std::isfinite(stop.arrival_s) && std::isfinite(stop.departure_s);
    });
  }
  static bool all_finite(const auto& path_m) {
    return std::ranges::all_of(path_m, [](const auto& p) { return p.allFinite(); });
  }
};

/// A number that classify() takes for that state.
float log_odds_in(CellState state) {
  if (state == CellState::unobserved) return 0.0F;
  return state == CellState::occupied ? 1.0F : -1.0F;
}

}  // namespace

MapChange map_change(std::vector<CellState>& known, const OccupancyGrid& grid) {
  known.resize(grid.size(), CellState::unobserved);
  MapChange change;
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    const CellState state = grid.state(cell);
    if (state == known[cell]) continue;
    known[cell] = state;
    const auto index = static_cast<std::uint32_t>(cell);
    auto& runs = change.runs;
    if (!runs.empty() && runs.back().state == state &&
        runs.back().first + runs.back().count == index) {
      ++runs.back().count;
    } else {
      runs.push_back({index, 1, state});
    }
  }
  return change;
}

EventLog::EventLog(const std::filesystem::path& run_dir) : file_(run_dir / "story.bin") {
  file_.write(kMagic);
}

void EventLog::add(const EpisodeEvent& event) {
  std::string bytes;
  put(bytes, event.tick);
  std::visit(PutEntries{bytes}, event.what);
  file_.write(bytes);
}

std::vector<EpisodeEvent> read_event_log(const std::filesystem::path& path, std::size_t cells) {
  const std::string content = read_file(path);
  ByteReader reader(content, path.string());
  reader.require(content.starts_with(kMagic), "not an event log of this program");
  reader.block(kMagic.size(), "the header");
  std::vector<EpisodeEvent> events;
  while (reader.left() > 0) {
    const std::string what = fmt::format("event {}", events.size());
    EpisodeEvent event = take_event(reader, what);
    const bool in_order = events.empty() || events.back().tick <= event.tick;
    reader.require(in_order && std::visit(Plausible{cells}, event.what), what + " is damaged");
    events.push_back(std::move(event));
  }
  return events;
}

void EventReplay::go_to(std::span<const EpisodeEvent> events, std::size_t count) {
  expects(count <= events.size(), "a moment of the event log");
  if (count < applied_) *this = EventReplay(grid_.frame);
  for (; applied_ < count; ++applied_) {
    std::visit([this](const auto& what) { apply(what); }, events[applied_].what);
  }
}

void EventReplay::apply(const MapChange& change) {
  for (const CellRun& run : change.runs) {
    std::fill_n(grid_.log_odds.begin() + run.first, run.count, log_odds_in(run.state));
  }
  tour_ = {};
  ++scans_;
}

void EventReplay::apply(const Decision& decision) {
  decision_ = decision;
  tour_ = {};
  path_m_.clear();
}

void EventReplay::apply(const PlannedRoute& route) {
  path_m_.clear();
  for (const Eigen::Vector2d& p : route.path_m) path_m_.emplace_back(p.x(), p.y(), 0.0);
}

void EventReplay::apply(const PlannedFlight& flight) { path_m_ = flight.path_m; }

}  // namespace vantage
