/// An exploration without physics: what a sweep without noise would see is seen, a drive takes what
/// it takes on average. An episode in seconds, to try choices with; it proves nothing of a robot.
#pragma once

#include <optional>
#include <vector>

#include "vantage/belief/map/clutter_hazard.hpp"
#include "vantage/core/rng.hpp"
#include "vantage/planners/choice/view_problem.hpp"
#include "vantage/tasks/episode.hpp"
#include "vantage/tasks/exploration/exploration_map_evaluator.hpp"
#include "vantage/tasks/exploration/simulated_exploration_robot.hpp"
#include "vantage/tasks/exploration/visited_places.hpp"

namespace vantage::bench {

/// A building with its robot: made once for any number of explorations.
struct ModelledBuilding {
  explicit ModelledBuilding(ResolvedEpisode episode);

  struct Evaluator : ExplorationMapEvaluator {
    using ExplorationMapEvaluator::ExplorationMapEvaluator;
    using ExplorationMapEvaluator::surface;
  };
  const ResolvedEpisode resolved;
  const Exploration task;
  SimulatedExplorationRobot robot;
  MobileGroundTruth truth;
  Evaluator evaluator;
};

/// What it took until a share of the observable cells was observed.
struct ReachedShare {
  double share = 0.0;
  double time_s = 0.0;
  double way_m = 0.0;
  int scans = 0;  ///< 0: it was not reached
};

class ModelledExploration {
 public:
  /// @param building outlives this @param task its choice, gain and planning
  ModelledExploration(const ModelledBuilding& building, const Exploration& task);

  /// Explores until the last of `shares` is reached, or no view is left, or no scan.
  std::vector<ReachedShare> run(const std::vector<double>& shares);

 private:
  void scan();
  void learn_hazard(const Pose& T_world_sweep);
  void note_shares(std::vector<ReachedShare>& levels) const;
  /// To the next view and there. @return false if there is none
  bool go_on();
  std::size_t chosen(const PathField& paths, std::vector<Candidate>& views);
  std::size_t next_of_plan(const PathField& paths, const BlockField& transmission,
                           const std::vector<Candidate>& views);
  void drive(const PlannedPath& path);
  /// Of the scan to come, where the robot is now.
  void choose_images(double way_s);
  void look_at_walls();
  void traverse(double radius_m);

  const ModelledBuilding& building_;
  const Exploration task_;
  OccupancyGrid grid_;
  ClutterHazard hazard_;
  FloorMap floor_;
  std::vector<std::uint8_t> traversed_;
  VisitedPlaces visited_;
  TravelTime travel_;
  Pose2 pose_;
  std::optional<Eigen::Vector2d> intended_m_;
  Rng choice_rng_;
  Rng noise_rng_{1};
  double time_s_;
  double way_m_ = 0.0;
  int scans_ = 0;
  std::optional<PartialScans> partial_scans_;  ///< none: every scan is a whole one
  std::vector<std::size_t> images_;            ///< of the scan to come; none: all
};

}  // namespace vantage::bench
