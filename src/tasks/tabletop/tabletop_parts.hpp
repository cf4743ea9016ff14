/// The parts of the loop for probabilistic next best view on a table top.  [Potthast2016, chapter
/// 3]
#pragma once

#include <string>
#include <vector>

#include "vantage/tasks/mapping/mapping_parts.hpp"
#include "vantage/tasks/tabletop/tabletop_belief.hpp"
#include "vantage/tasks/tabletop/tabletop_robot_interface.hpp"

namespace vantage {

/// The ring of views in id order: where the robot may scan from.
std::vector<Candidate> tabletop_views(const Tabletop& task);

class TabletopParts : public MappingParts {
 public:
  TabletopParts(const MappingContext& context, const Tabletop& task, TabletopRobotInterface& robot,
                TabletopBelief& belief);

  TabletopObservation observe();
  void update(const TabletopObservation& observation);
  void record() { record_scan(); }
  [[nodiscard]] std::string finished();
  std::vector<Candidate> propose();
  void act(const Candidate& candidate);
  void end() { MappingParts::end(reachable_views()); }

 private:
  /// The views with the ways to them from here.
  std::vector<Candidate> reachable_views();
  void block_table();
  void leave_view(const Pose2& T_world_base);

  const Tabletop task_;
  TabletopRobotInterface& tabletop_robot_;
  TabletopBelief& belief_;
  std::vector<float> last_line_;  ///< of the scan before, as it came
};

}  // namespace vantage
