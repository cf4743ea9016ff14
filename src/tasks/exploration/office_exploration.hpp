/// The parts of the loop for the exploration of an office by its frontiers.  [Potthast2016,
/// chapter 3], [Yamauchi1997]
#pragma once

#include <vector>

#include "vantage/planners/candidate.hpp"
#include "vantage/tasks/exploration/exploration_map_evaluator.hpp"
#include "vantage/tasks/exploration/exploration_robot_interface.hpp"
#include "vantage/tasks/exploration/office_belief.hpp"
#include "vantage/tasks/exploration/visited_places.hpp"
#include "vantage/tasks/mapping/navigator.hpp"
#include "vantage/tasks/mapping/recorder.hpp"
#include "vantage/tasks/mapping/scan_record.hpp"

namespace vantage {

class OfficeExploration {
 public:
  OfficeExploration(const ResolvedEpisode& resolved, ExplorationRobotInterface& robot,
                    Recorder& recorder);

  OfficeObservation observe();
  void update(const OfficeObservation& observation);
  void record();
  [[nodiscard]] bool finished() const;
  std::vector<Candidate> propose();
  void score(std::vector<Candidate>& candidates);
  std::size_t choose(const std::vector<Candidate>& candidates);
  void act(const Candidate& candidate);

  [[nodiscard]] const std::vector<ScanRecord>& scans() const { return scans_; }
  [[nodiscard]] const OfficeBelief& belief() const { return belief_; }
  [[nodiscard]] const ExplorationMapEvaluator& truth() const { return truth_; }
  /// Those of the next decision, and after it those it was made among.
  [[nodiscard]] const std::vector<Candidate>& views() const { return views_; }

 private:
  void predict(const Pose& T_world_sweep);
  void block_floor();
  std::vector<Candidate> find_views();
  /// What the views show by the clutter learnt, in bits.
  [[nodiscard]] std::vector<double> learnt_gains_bits(const Gain& gain) const;
  void update_stopping_criterion();
  [[nodiscard]] bool is_enough() const;
  [[nodiscard]] MapPanelInput panel() const;

  Episode episode_;
  ExplorationRobotInterface& robot_;
  Recorder& recorder_;
  OfficeBelief belief_;
  ExplorationMapEvaluator truth_;
  Navigator navigator_;
  std::vector<std::uint8_t> traversed_;  ///< per floor cell: the robot has traversed it
  std::size_t path_traversed_ = 0;       ///< points of the path so far
  VisitedPlaces visited_;
  Rng choice_rng_;
  std::vector<Candidate> views_;
  bool are_views_weighed_ = false;
  int poor_promises_ = 0;          ///< scans in a row after which no view was worth one more
  double decision_start_s_ = 0.0;  ///< wall
  ScanRecord current_;             ///< filled in from the decision to the end of its scan
  std::vector<ScanRecord> scans_;
};

}  // namespace vantage
