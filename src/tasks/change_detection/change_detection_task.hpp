/// The task `change_detection`: a quadrotor looks whether an object on a table is still what and
/// how its map says.  [Potthast2016, 4.5.8]
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <string_view>

#include "vantage/recognition/change_detection.hpp"
#include "vantage/runtime/measure.hpp"
#include "vantage/runtime/record_text.hpp"
#include "vantage/sim/world/model_source.hpp"
#include "vantage/tasks/object_flight/object_flight.hpp"
#include "vantage/tasks/object_flight/object_on_table.hpp"

namespace vantage {

struct ChangeDetectionTask : ObjectFlight {
  static constexpr std::string_view name = "change_detection";
  static constexpr StrategyText text{
      .summary =
          "A quadrotor looks whether an object on a table is still what, and as, its map says: the "
          "same, another one, turned or removed.",
      .source = "Potthast2016, 4.5.8"};

  std::string scenario = "none";
  std::string expected_object;
  std::optional<double> expected_yaw_rad;
  std::optional<double> turned_rad;
  ChangeOptions change;  ///< its `recognition` is not read: `decision` holds

  ChangeDetectionTask() { decision = for_changes(decision); }
  void fields(auto&& f) {
    ObjectFlight::fields(f);
    f("scenario", scenario,
      "what has changed on the table: `none`, `object`, `pose` or `removed`; the robot is not "
      "told");
    f("expected_object", expected_object,
      "object that the map says stands on the table; empty: drawn by the seed");
    f("expected_yaw_rad", expected_yaw_rad,
      "yaw that the map says the object has, in the world frame; null: drawn by the seed",
      between(-1000.0, 1000.0));
    f("turned_rad", turned_rad,
      "scenario `pose`: how far the object was turned; null: drawn by the seed, at least "
      "22.5 deg",
      between(-1000.0, 1000.0));
    change.decision_fields(f);
  }
  void check_with(const EpisodeOptions& episode) const;

  [[nodiscard]] ModelSource model_source(const EpisodeSetup& setup) const;
  [[nodiscard]] static ReportSections report();
  [[nodiscard]] static std::string_view metrics_task() { return name; }
  [[nodiscard]] static std::string_view robot_kind() { return QuadrotorDescription::name; }
  [[nodiscard]] static Measures measures();
  [[nodiscard]] static RecordTexts records();
  [[nodiscard]] static std::string outcome(const nlohmann::ordered_json& metrics);
  /// @throws ConfigError or InputError if the episode cannot begin.
  void require_start(const EpisodeSetup& setup) const;
  RunOutcome run(const RunRequest& request) const;
};

/// What the map says: it stands in the table's middle.
/// @throws ConfigError if `expected_object` is none of the database's, InputError as
/// known_objects().
ObjectOnTable draw_expected_object(const ChangeDetectionTask& task, std::uint64_t seed);

}  // namespace vantage
