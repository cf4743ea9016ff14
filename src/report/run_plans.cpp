#include "vantage/report/run_plans.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "vantage/core/error.hpp"
#include "vantage/report/report_data.hpp"

namespace vantage {
namespace {

/// A row of plans.csv, by the names of its columns.
class PlanRow {
 public:
  PlanRow(const CsvTable& table, std::size_t row, std::string file)
      : table_(table), fields_(table.rows[row]), line_(row + 2), file_(std::move(file)) {}

  [[noreturn]] void fail(const std::string& why) const {
    throw InputError(fmt::format("{}:{}: {}", file_, line_, why));
  }
  [[nodiscard]] const std::string& text(std::string_view column) const {
    const auto found = std::ranges::find(table_.columns, column);
    if (found == table_.columns.end()) fail(fmt::format("no column {}", column));
    return fields_[static_cast<std::size_t>(found - table_.columns.begin())];
  }
  [[nodiscard]] double number(std::string_view column) const {
    const std::string& field = text(column);
    double value = 0.0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc{} || end != field.data() + field.size() || !std::isfinite(value)) {
      fail(fmt::format("{}: expected a number", column));
    }
    return value;
  }
  [[nodiscard]] double number_or(std::string_view column, double none) const {
    return text(column).empty() ? none : number(column);
  }
  /// From `least` on.
  [[nodiscard]] int whole(std::string_view column, int least) const {
    const double value = number(column);
    if (value < least || value > 1e9 || value != std::floor(value)) {
      fail(fmt::format("{}: expected a whole number from {} on", column, least));
    }
    return static_cast<int>(value);
  }

 private:
  const CsvTable& table_;
  const std::vector<std::string>& fields_;
  std::size_t line_;
  std::string file_;
};

RecordedPlan plan_begun_by(const PlanRow& row) {
  const auto change = plan_change_of(row.text("change"));
  if (!change) row.fail("change: " + row.text("change") + " is none");
  RecordedPlan plan;
  plan.scan = static_cast<std::size_t>(row.whole("scan", 1));
  plan.time_s = row.number("time_s");
  plan.gain_unit = row.text("gain_unit");
  plan.tour.reason = {*change, row.number_or("saved_s", std::numeric_limits<double>::quiet_NaN())};
  return plan;
}

PlannedStop stop_of(const PlanRow& row) {
  return {.id = row.text("candidate").empty() ? -1 : row.whole("candidate", 0),
          .place_m = {row.number("x_m"), row.number("y_m")},
          .yaw_rad = row.number("yaw_rad"),
          .arrival_s = row.number("arrival_s"),
          .departure_s = row.number("departure_s"),
          .gain = row.number("gain"),
          .beyond = row.number("beyond")};
}

nlohmann::json stop_json(const PlannedStop& stop) {
  return {{"id", stop.id},       {"x", stop.place_m.x()},       {"y", stop.place_m.y()},
          {"yaw", stop.yaw_rad}, {"arrival_s", stop.arrival_s}, {"departure_s", stop.departure_s},
          {"gain", stop.gain},   {"beyond", stop.beyond}};
}

}  // namespace

std::vector<RecordedPlan> read_plans(const std::filesystem::path& path) {
  const CsvTable table = read_csv(path);
  std::vector<RecordedPlan> plans;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const PlanRow row(table, i, path.string());
    if (row.whole("stop", 1) == 1) {
      RecordedPlan plan = plan_begun_by(row);
      if (!plans.empty() && plan.scan <= plans.back().scan) row.fail("scan: not in order");
      plans.push_back(std::move(plan));
    }
    const bool follows =
        !plans.empty() && static_cast<std::size_t>(row.whole("scan", 1)) == plans.back().scan &&
        static_cast<std::size_t>(row.whole("stop", 1)) == plans.back().tour.stops.size() + 1;
    if (!follows) row.fail("stop: does not follow the row before");
    plans.back().tour.stops.push_back(stop_of(row));
  }
  return plans;
}

nlohmann::json plans_json(const std::filesystem::path& path) {
  nlohmann::json list = nlohmann::json::array();
  for (const RecordedPlan& plan : read_plans(path)) {
    nlohmann::json stops = nlohmann::json::array();
    for (const PlannedStop& stop : plan.tour.stops) stops.push_back(stop_json(stop));
    list.push_back({{"scan", plan.scan},
                    {"time_s", plan.time_s},
                    {"change", name_of(plan.tour.reason.change)},
                    {"why", sentence_of(plan.tour.reason)},
                    {"ends_s", plan.tour.ends_s()},
                    {"unit", plan.gain_unit},
                    {"stops", std::move(stops)}});
  }
  return list;
}

}  // namespace vantage
