/// The parts of the loop for the exploration of rooms by their frontiers.  [Potthast2016, chapter
/// 3], [Yamauchi1997]
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vantage/tasks/exploration/exploration_belief.hpp"
#include "vantage/tasks/exploration/exploration_robot_interface.hpp"
#include "vantage/tasks/exploration/visited_places.hpp"
#include "vantage/tasks/mapping/mapping_parts.hpp"

namespace vantage {

/// The gains whose prediction is recorded: unless named, those that can be swept.
std::vector<Predictor> exploration_predictors(const Exploration& task);

class ExplorationParts : public MappingParts {
 public:
  ExplorationParts(const MappingContext& context, const Exploration& task,
                   ExplorationRobotInterface& robot, ExplorationBelief& belief);

  ExplorationObservation observe();
  void update(const ExplorationObservation& observation);
  void record();
  [[nodiscard]] std::string finished() const;
  std::vector<Candidate> propose() { return views_; }
  void act(const Candidate& candidate);
  void end();

 private:
  void traverse(const Eigen::Vector2d& p_m, double radius_m);
  void block_floor();
  /// @param scanning see correct_records()
  void correct_map(const PoseCorrection& correction, bool scanning);
  /// @param missed images that were to be taken from there
  void visit(const Eigen::Vector2d& p_m, double radius_m, bool missed = false);
  /// While it drives: takes an image now and then, and turns the head to where the next promises
  /// most.
  void look_on_the_way();
  /// From there, by the pose tracked on the way, into the map.
  void take_image(const Pose2& T_world_base);
  /// Where the robot stands now: takes the images that are worth their time.
  void choose_images();
  void take_all_images();
  /// @param all those of all frontiers, not only of the largest
  std::vector<Candidate> find_views(bool all);
  void judge_what_is_left();
  void update_stopping_criterion();
  [[nodiscard]] bool is_enough() const;
  /// Why no view is worth taking; empty if one is.
  [[nodiscard]] std::string explored() const;

  const Exploration task_;
  ExplorationRobotInterface& exploring_robot_;
  ExplorationBelief& belief_;
  std::vector<std::uint8_t> traversed_;         ///< per floor cell: the robot has traversed it
  std::vector<std::uint8_t> traversed_detail_;  ///< the same of the finer map
  Eigen::Vector2d p_start_m_ = Eigen::Vector2d::Zero();
  std::size_t path_traversed_ = 0;   ///< points of the path so far
  std::vector<std::size_t> images_;  ///< of the scan to come; none: all
  VisitedPlaces visited_;
  std::vector<std::size_t> visited_at_;  ///< keyframe of each
  bool missed_images_ = false;           ///< the last scan: some did not come
  CameraImages last_image_;              ///< that came
  std::optional<Pose2> last_look_;       ///< on this way: where the last was taken
  double yaw_on_the_way_rad_ = 0.0;      ///< when it was last told
  int poor_promises_ = 0;                ///< scans in a row after which no view was worth one more
};

}  // namespace vantage
