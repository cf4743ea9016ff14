/// The parts of the loop for probabilistic next best view on a table top.  [Potthast2016, chapter
/// 3]
#pragma once

#include <vector>

#include "vantage/planners/candidate.hpp"
#include "vantage/tasks/mapping/ground_truth_map_evaluator.hpp"
#include "vantage/tasks/mapping/navigator.hpp"
#include "vantage/tasks/mapping/recorder.hpp"
#include "vantage/tasks/mapping/scan_record.hpp"
#include "vantage/tasks/tabletop/tabletop_belief.hpp"
#include "vantage/tasks/tabletop/tabletop_robot_interface.hpp"

namespace vantage {

class NextBestView {
 public:
  NextBestView(const ResolvedEpisode& resolved, TabletopRobotInterface& robot, Recorder& recorder);

  TabletopObservation observe();
  void update(const TabletopObservation& observation);
  void record();
  [[nodiscard]] bool finished() const;
  std::vector<Candidate> propose();
  void score(std::vector<Candidate>& candidates);
  std::size_t choose(const std::vector<Candidate>& candidates);
  void act(const Candidate& candidate);

  [[nodiscard]] const std::vector<ScanRecord>& scans() const { return scans_; }
  [[nodiscard]] const TabletopBelief& belief() const { return belief_; }
  [[nodiscard]] const GroundTruthMapEvaluator& truth() const { return truth_; }
  [[nodiscard]] const std::vector<Candidate>& views() const { return views_; }

 private:
  void predict(const Pose& T_world_sensor);
  void block_table();
  [[nodiscard]] MapPanelInput panel() const;

  Episode episode_;
  TabletopRobotInterface& robot_;
  Recorder& recorder_;
  std::vector<Candidate> views_;  ///< the ring, in id order
  TabletopBelief belief_;
  GroundTruthMapEvaluator truth_;
  Navigator navigator_;
  Rng choice_rng_;
  double decision_start_s_ = 0.0;  ///< wall
  ScanRecord current_;             ///< filled in from the decision to the end of its scan
  std::vector<ScanRecord> scans_;
};

}  // namespace vantage
