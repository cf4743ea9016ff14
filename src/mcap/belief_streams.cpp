// What the robot knew, weighed and planned, and the rows of steps.csv.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <variant>

#include "vantage/mcap/messages.hpp"
#include "vantage/mcap/run_streams.hpp"
#include "vantage/perception/clouds/ply.hpp"
#include "vantage/report/report_data.hpp"
#include "vantage/runtime/json.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr MarkerColour kUnreachable{0.5, 0.5, 0.5, 0.35};
constexpr MarkerColour kChosen{0.95, 0.2, 0.15, 1.0};
constexpr MarkerColour kPlan{0.1, 0.75, 0.3, 1.0};
constexpr double kViewLength_m = 0.25;
constexpr double kChosenLength_m = 0.45;

/// From blue, nothing, to yellow, the most.
MarkerColour colour_of(double share) {
  return {share, 0.25 + 0.6 * share, 0.9 * (1.0 - share), 0.9};
}

std::vector<SceneEntity> decision_entities(const Decision& decision) {
  double most = 0.0;
  for (const Candidate& view : decision.candidates) most = std::max(most, view.gain_bits);
  SceneEntity views{.id = "views"};
  for (const Candidate& view : decision.candidates) {
    const double share = most > 0.0 ? std::clamp(view.gain_bits / most, 0.0, 1.0) : 0.0;
    views.arrows.push_back(
        {view.T_world_sensor, kViewLength_m, view.reachable ? colour_of(share) : kUnreachable});
  }
  SceneEntity chosen{.id = "chosen"};
  if (decision.chosen < decision.candidates.size()) {
    const Candidate& view = decision.candidates[decision.chosen];
    chosen.arrows.push_back({view.T_world_sensor, kChosenLength_m, kChosen});
    chosen.metadata = {{"id", std::to_string(view.id)},
                       {"gain", fmt::format("{}", view.gain_bits)}};
  }
  return {views, chosen};
}

std::vector<Eigen::Vector3d> path_of(const PlannedRoute& route) {
  std::vector<Eigen::Vector3d> path_m;
  for (const Eigen::Vector2d& p : route.path_m) path_m.emplace_back(p.x(), p.y(), 0.02);
  return path_m;
}
std::vector<Eigen::Vector3d> path_of(const PlannedFlight& flight) { return flight.path_m; }

void add_path(std::size_t stream, double time_s, std::vector<Eigen::Vector3d> path_m,
              Timeline& timeline) {
  timeline.add(stream, time_s, [time_s, path_m = std::move(path_m)] {
    if (path_m.empty()) return scene_update(time_s, {}, {"plan"});
    return scene_update(time_s, {{.id = "plan", .path_m = path_m, .path_colour = kPlan}});
  });
}

std::vector<Eigen::Vector3f> occupied_centres(const OccupancyGrid& grid) {
  std::vector<Eigen::Vector3f> centres;
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    if (grid.state(cell) != CellState::occupied) continue;
    centres.emplace_back(grid.frame.centre(grid.frame.cell(cell)).cast<float>());
  }
  return centres;
}

/// Empty fields are null; what is neither number nor truth value is a text.
Json value_json(const std::string& field) {
  if (field.empty()) return nullptr;
  if (field == "true" || field == "false") return field == "true";
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || end != field.data() + field.size()) return field;
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json step_schema(const CsvTable& steps) {
  Json properties = Json::object();
  for (const std::string& column : steps.columns) {
    properties[column] = {{"type", {"number", "boolean", "string", "null"}}};
  }
  for (std::size_t i = 0; i < steps.columns.size(); ++i) {
    const bool numbers = std::ranges::none_of(steps.rows, [&](const auto& row) {
      const Json value = value_json(row[i]);
      return !value.is_number() && !value.is_null();
    });
    if (numbers) properties[steps.columns[i]] = {{"type", {"number", "null"}}};
  }
  return {{"title", "vantage.Step"}, {"type", "object"}, {"properties", properties}};
}

}  // namespace

void add_decisions(const RunToExport& run, Timeline& timeline) {
  const std::size_t views = timeline.add_stream("/views", "SceneUpdate");
  const std::size_t plan = timeline.add_stream("/plan", "SceneUpdate");
  for (const EpisodeEvent& event : run.events()) {
    const double time_s = run.time_s(event);
    if (const auto* decision = std::get_if<Decision>(&event.what)) {
      timeline.add(views, time_s, [time_s, decision] {
        return scene_update(time_s, decision_entities(*decision));
      });
      add_path(plan, time_s, {}, timeline);
    } else if (const auto* route = std::get_if<PlannedRoute>(&event.what)) {
      add_path(plan, time_s, path_of(*route), timeline);
    } else if (const auto* flight = std::get_if<PlannedFlight>(&event.what)) {
      add_path(plan, time_s, path_of(*flight), timeline);
    }
  }
}

void add_map(const RunToExport& run, Timeline& timeline) {
  if (!run.map()) return;
  const std::size_t stream = timeline.add_stream("/map/occupied", "PointCloud");
  const auto map = std::make_shared<EventReplay>(*run.map());
  for (std::size_t i = 0; i < run.events().size(); ++i) {
    if (!std::holds_alternative<MapChange>(run.events()[i].what)) continue;
    const double time_s = run.time_s(run.events()[i]);
    timeline.add(stream, time_s, [&run, map, i, time_s] {
      map->go_to(run.events(), i + 1);
      return point_cloud(time_s, occupied_centres(map->grid()));
    });
  }
}

void add_cloud(const RunToExport& run, Timeline& timeline) {
  const fs::path file = run.directory() / "cloud.ply";
  if (!fs::exists(file)) return;
  const std::size_t stream = timeline.add_stream("/cloud", "PointCloud");
  timeline.add(stream, run.end_s(), [file, time_s = run.end_s()] {
    return point_cloud(time_s, read_ply(file).cloud.points);
  });
}

void add_steps(const RunToExport& run, Timeline& timeline) {
  const fs::path file = run.directory() / "steps.csv";
  if (!fs::exists(file)) return;
  const auto steps = std::make_shared<const CsvTable>(read_csv(file));
  const auto time = std::ranges::find(steps->columns, "time_s");
  if (time == steps->columns.end()) return;
  const auto column = static_cast<std::size_t>(time - steps->columns.begin());
  timeline.streams.push_back({"/steps", "vantage.Step", json_line(step_schema(*steps))});
  for (const auto& row : steps->rows) {
    const Json at = value_json(row[column]);
    if (!at.is_number()) continue;
    timeline.add(timeline.streams.size() - 1, at.get<double>(), [steps, &row] {
      Json step = Json::object();
      for (std::size_t i = 0; i < row.size(); ++i) step[steps->columns[i]] = value_json(row[i]);
      return step;
    });
  }
}

}  // namespace vantage
