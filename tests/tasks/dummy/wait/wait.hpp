/// The task `wait`: a mobile robot stays where it is, turns in place between scans of its planar
/// scanner and counts their returns. A dummy, as small as a whole task can be.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/core/fields.hpp"
#include "vantage/runtime/episode_run.hpp"
#include "vantage/runtime/measure.hpp"
#include "vantage/runtime/record_text.hpp"
#include "vantage/runtime/task_answers.hpp"
#include "vantage/sim/robots/robot_description.hpp"
#include "vantage/sim/sensors/laser_options.hpp"
#include "vantage/sim/world/model_source.hpp"

namespace vantage {

struct Wait {
  static constexpr std::string_view name = "wait";
  static constexpr StrategyText text{.summary =
                                         "A mobile robot stays where it is, turns in place between "
                                         "scans and counts their returns."};

  int scans = 3;
  double turning_rate_rad_s = 0.8;
  double turning_time_s = 0.5;
  PlanarScannerOptions base_scanner;
  void fields(auto&& f) {
    f("scans", scans, "greatest number of scans, the first one included", between(1, 1000));
    f("turning_rate_rad_s", turning_rate_rad_s,
      "turn rate between scans, to either side; higher turns farther", between(0.0, 1.5));
    f("turning_time_s", turning_time_s, "time of turning between scans; higher turns farther",
      between(0.0, 60.0));
    f("base_scanner", base_scanner, "planar laser scanner whose returns are counted");
  }
  [[nodiscard]] std::string method_name() const { return "either side"; }
  /// @throws ConfigError if a turn is shorter than a control period
  void check_with(const EpisodeOptions& episode) const;

  void find_files(const std::filesystem::path&) {}
  [[nodiscard]] std::vector<InputFile> inputs() const { return {}; }
  [[nodiscard]] ModelSource model_source(const EpisodeSetup& setup) const;
  [[nodiscard]] TaskExtent extent(const EpisodeSetup& setup) const;
  [[nodiscard]] WindowContent window() const;
  [[nodiscard]] static ReportSections report();
  [[nodiscard]] static std::string_view metrics_task() { return name; }
  [[nodiscard]] static std::string_view robot_kind() { return MobileBaseDescription::name; }
  [[nodiscard]] static Measures measures();
  [[nodiscard]] static RecordTexts records();
  [[nodiscard]] static std::string outcome(const nlohmann::ordered_json& metrics);
  /// @throws InputError if the model lacks what robot.yaml names.
  void require_start(const EpisodeSetup& setup) const;
  RunOutcome run(const RunRequest& request) const;
};

}  // namespace vantage
