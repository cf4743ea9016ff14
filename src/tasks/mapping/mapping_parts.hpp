/// What the parts of the loop of all mapping tasks share: localise, update, predict, measure,
/// drive. Tasks differ in how they propose views and act.  [Potthast2016, chapter 3]
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "vantage/core/parallel_for.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/planners/candidate.hpp"
#include "vantage/planners/choice/outside_choice.hpp"
#include "vantage/planners/travel/path_lengths.hpp"
#include "vantage/planners/views/forecast_calibration.hpp"
#include "vantage/planners/views/forecast_interval.hpp"
#include "vantage/tasks/mapping/driving/navigator.hpp"
#include "vantage/tasks/mapping/ground_truth_map_evaluator.hpp"
#include "vantage/tasks/mapping/localisation_summary.hpp"
#include "vantage/tasks/mapping/map_belief.hpp"
#include "vantage/tasks/mapping/mapping_recorder.hpp"
#include "vantage/tasks/mapping/view_planner.hpp"

namespace vantage {

/// What the parts work with; all of it outlives them.
struct MappingContext {
  const EpisodeOptions& options;
  MobileRobotInterface& robot;
  const GroundTruthMapEvaluator& evaluator;  ///< asked when recording, and by the oracles
  MappingRecorder& recorder;
  const OutsideChoice* outside = nullptr;  ///< chooses in place of the task's own choice
};

class MappingParts {
 public:
  MappingParts(const MappingParts&) = delete;
  MappingParts& operator=(const MappingParts&) = delete;

  void score(std::vector<Candidate>& candidates);
  /// A choice from outside may add a candidate of its own.
  std::size_t choose(std::vector<Candidate>& candidates);

  [[nodiscard]] const std::vector<ScanRecord>& scans() const { return scans_; }
  [[nodiscard]] const BudgetKeeper& budget() const { return budget_; }
  /// Why the map is not to be trusted, by what the robot knows of its own pose; empty if it is.
  [[nodiscard]] std::string distrust() const;
  /// How the scans fit together, and why that leaves the map in doubt.
  LocalisationSummary localisation();
  /// Those of the next decision, and after it those it was made among.
  [[nodiscard]] const std::vector<Candidate>& views() const { return views_; }

 protected:
  /// @param belief outlives this @param trained how far forecasts of such scans are off
  MappingParts(const MappingContext& context, const MappingOptions& options,
               const MapBelief& belief, std::vector<Predictor> predictors, Navigator navigator,
               const ForecastLaw& trained);
  ~MappingParts() = default;

  /// What there was before an update.
  struct Before {
    double start_s;  ///< wall
    OccupancyGrid grid;
    Pose2 dead_reckoned;  ///< the wheels alone since the scan before
    Pose2 tracked;        ///< with the corrections on the way: what registration starts from
  };

  void look_round_at_start();
  /// The observation that `observe` makes, timed.
  auto observed(auto&& observe) {
    const double start_s = robot_.time_s();
    const double start_j = robot_.energy_used_j();
    auto observation = observe();
    current_.scan_time_s = robot_.time_s() - start_s;
    current_.scan_energy_j = robot_.energy_used_j() - start_j;
    return observation;
  }
  /// The first observation that shows something: one that does not is made again, a few times.
  /// @param take makes an observation, says only what it is sure of and whether that is anything
  /// @throws EpisodeFailed
  template <class Observation>
  Observation first_usable(const std::function<bool(Observation&)>& take) {
    for (int attempt = 1;; ++attempt) {
      Observation observation;
      if (take(observation)) return observation;
      note_useless(attempt);
    }
  }
  [[nodiscard]] Before before_update();
  void correct_pose(const BeliefUpdate& update);
  void measure(const Before& before, const BeliefUpdate& update, const Pose& T_world_sensor);
  /// Loops have moved what was mapped: so have all records. @param scanning the map is that of the
  /// scan under way, too; else it is after the last one
  void correct_records(const PoseCorrection& correction, const Pose& T_base_sensor, bool scanning);
  /// Loops that left the poses where they were make the map as sure as those that moved them.
  void note_agreeing_loops();
  const ScanRecord& record_scan();
  /// What the scan to come will show, seen from there.
  /// @param in_sight what of the field it looks at; none: all of it
  void predict(const Pose& T_world_sensor, InSight in_sight = {});
  /// From where images are about to be taken.
  /// @param grid outlives what is returned
  [[nodiscard]] Lookout lookout(const OccupancyGrid& grid, const Pose& T_world_sensor) const;
  /// Of a scan from there, which it has taken so long to get to; there are partial_scans_.
  [[nodiscard]] std::vector<std::size_t> images_worth_taking(const Pose& T_world_sensor,
                                                             double way_s) const;
  [[nodiscard]] std::vector<double> gains_bits(const Gain& gain, std::span<const Candidate> views,
                                               int threads) const;
  /// Drives to a view, or as near as possible; see Navigator::approach().
  Approach approach(const Candidate& view, const std::optional<Eigen::Vector2d>& look_at_m);
  void warn_not_reached(const Candidate& view, const Approach& approach) const;
  void start_decision();
  /// The views that `oracle_tour` alone may take: of all places where a robot could stand those
  /// that are in reach now, or those that are not yet. None of another choice, or at a table.
  [[nodiscard]] std::vector<Candidate> views_of_truth(const PathField& paths, bool in_reach) const;
  /// Cells that these views are expected to show together, by `adaptive`.
  [[nodiscard]] double expected_left_cells(const std::vector<Candidate>& views);
  /// Why no further scan is taken once there are as many as were asked for, or none of these views
  /// can be paid; else empty.
  [[nodiscard]] std::string limit_reached(const std::vector<Candidate>& views) const;
  /// After the last scan: tells a choice from outside, and drives back to the start if that is
  /// asked for. @param views worth taking that are left
  void end(const std::vector<Candidate>& views);

  const EpisodeOptions& episode_;
  MobileRobotInterface& robot_;
  MappingRecorder& recorder_;
  Navigator navigator_;
  BudgetKeeper budget_;
  std::optional<PartialScans> partial_scans_;  ///< none: every scan is a whole one
  std::vector<Candidate> views_;
  bool views_have_gains_ = false;
  bool scans_tell_pose_ = true;  ///< by what the scanner saw at the start
  PlannedTour tour_;             ///< of the last decision, if its choice planned ahead
  FormerPlan former_ = FormerPlan::none;
  std::optional<Eigen::Vector2d>
      intended_m_;                 ///< where the plan wants to scan after its first view
  double decision_start_s_ = 0.0;  ///< wall
  ScanRecord current_;             ///< filled in from the decision to the end of its scan
  std::vector<ScanRecord> scans_;

 private:
  struct Prediction {
    std::vector<std::pair<std::string, double>> cells;  ///< of each predictor
    std::vector<PredictionBand> by_distance;
    double at_half_cells = 0.0;  ///< with half the hazard
  };

  /// @throws EpisodeFailed after the last attempt
  void note_useless(int attempt) const;
  [[nodiscard]] int scans_left() const;
  [[nodiscard]] bool plan_has_gains() const;
  std::size_t own_choice(std::vector<Candidate>& candidates);
  std::size_t chosen_outside(std::vector<Candidate>& candidates);
  std::size_t next_of_plan(std::vector<Candidate>& candidates);
  void tell_truth(std::vector<Candidate>& candidates) const;
  [[nodiscard]] std::span<const Pose> poses_of_truth() const;
  [[nodiscard]] MapPanelInput panel() const;
  /// Of points about that pose where the region is, RMS.
  [[nodiscard]] double map_sigma_m(const Pose2& base, const Eigen::Matrix3d& covariance) const;
  /// @return covariances of (x, y, yaw) at these records' scans; none if no loops are looked for
  std::vector<Eigen::Matrix3d> note_pose_sigmas(std::span<ScanRecord* const> records) const;
  [[nodiscard]] BlockField transmission() const;
  [[nodiscard]] std::vector<PredictionBand> forecast(double hazard_factor, double width_m) const;
  [[nodiscard]] double predicted_by(const Gain& gain) const;
  [[nodiscard]] BackgroundWork::Parts parts_of_prediction();
  [[nodiscard]] bool in_background() const;
  void hold_forecast_against(const OccupancyGrid& before);

  const MappingOptions options_;
  const GroundTruthMapEvaluator& evaluator_;
  const OutsideChoice* outside_;
  const MapBelief& belief_;
  std::vector<Predictor> predictors_;
  ForecastCalibration calibration_;
  ForecastInterval interval_;
  double at_half_cells_ = 0.0;                 ///< of the scan to come, with half the hazard
  Pose T_world_predicted_ = Pose::Identity();  ///< of the sensor, for the scan to come
  InSight in_sight_;                           ///< of it, for the scan to come
  std::optional<PathLengths> true_ways_;       ///< once a choice that knows them has asked
  Rng choice_rng_;
  Prediction prediction_;
  BackgroundWork predicting_;  ///< under way since predict(); reads the above
};

}  // namespace vantage
