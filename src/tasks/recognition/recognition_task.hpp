/// The task `recognition`: a quadrotor flies round one object on a table until it knows what it is.
/// [Potthast2016, 4.5.7]
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string_view>

#include "vantage/perception/clutter/object_among_others.hpp"
#include "vantage/runtime/measure.hpp"
#include "vantage/runtime/record_text.hpp"
#include "vantage/sim/world/model_source.hpp"
#include "vantage/tasks/object_flight/object_flight.hpp"
#include "vantage/tasks/recognition/clutter_options.hpp"
#include "vantage/tasks/table_map/table_map.hpp"

namespace vantage {

/// Alone on the table, one object is cut out and looked at as it is; among others the robot keeps a
/// map and says what it does not see.
struct RecognitionTask : ObjectFlight {
  static constexpr std::string_view name = "recognition";
  static constexpr StrategyText text{
      .summary =
          "A quadrotor flies round an object on a table, alone or "
          "among others, to the views that tell most, until it knows "
          "what the object is.",
      .source = "Potthast2016, 4.5.7"};

  ClutterOptions clutter;
  int targets = 1;
  TableMapOptions map;
  SeparationOptions separation;
  double time_limit_s = 0.0;
  bool targets_at_once = true;
  void fields(auto&& f) {
    ObjectFlight::fields(f);
    f("clutter", clutter, "what stands round the objects that are to be recognised");
    f("targets", targets, "number of objects on the table that are to be recognised in one flight",
      between(1, 10));
    f("targets_at_once", targets_at_once,
      "true: views of all objects that are not known yet compete for the next flight; false: one "
      "object after the other, the nearest first");
    f("map", map, "map of the table that is kept where more than one object stands on it");
    f("separation", separation, "how an object is told from others that stand round it");
    f("time_limit_s", time_limit_s,
      "simulated time within which views are taken: none is flown to that would come later; 0: no "
      "limit",
      between(0.0, 36000.0));
  }
  /// Screens are no higher than the robot is told that anything is.
  void check_with(const EpisodeOptions& episode) const;
  /// Whether the table holds more than one object.
  [[nodiscard]] bool among_others() const { return targets > 1 || clutter.any(); }

  [[nodiscard]] TaskExtent extent(const EpisodeSetup& setup) const;
  [[nodiscard]] static WindowContent window() { return ObjectFlight::window(); }
  /// With the map, where one is kept.
  [[nodiscard]] WindowContent window(const EpisodeSetup& setup) const;
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

}  // namespace vantage
