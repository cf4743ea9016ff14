/// The task `recognition`: a quadrotor flies round one object on a table until it knows what it is.
/// [Potthast2016, 4.5.7]
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string_view>

#include "vantage/runtime/measure.hpp"
#include "vantage/runtime/record_text.hpp"
#include "vantage/sim/world/model_source.hpp"
#include "vantage/tasks/object_flight/object_flight.hpp"

namespace vantage {

struct RecognitionTask : ObjectFlight {
  static constexpr std::string_view name = "recognition";
  static constexpr StrategyText text{.summary =
                                         "A quadrotor flies round one object on a table, to the "
                                         "views that tell most, until it knows what the object is.",
                                     .source = "Potthast2016, 4.5.7"};

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
