/// Claims of the dissertation and goals of this project, each held against what was measured.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/results_tables.hpp"

namespace vantage::bench {

struct Finding {
  std::string source;    ///< "Fig. 3.10", or the goal
  std::string claim;     ///< what should be seen
  std::string measured;  ///< what was
  bool holds = false;
  std::string why;  ///< what explains it, if it does not
};

/// Figures of benchmarks by the benchmark's name: decision, scaling, office, episode.
using Figures = std::map<std::string, Json>;

std::vector<Finding> speed_findings(const Figures& figures);
std::vector<Finding> tabletop_findings(const StudySummary& study);
std::vector<Finding> prediction_findings(const StudySummary& study);
/// Of recognition and of change detection on the quadrotor.
std::vector<Finding> flight_recognition_findings(const StudySummary& study);
std::vector<Finding> flight_change_findings(const StudySummary& study);
/// Scans that the dissertation's best method takes.
struct ScansClaimed {
  int fewest = 0;
  int most = 0;
};
std::vector<Finding> office_findings(const StudySummary& study, const std::string& figure,
                                     const ScansClaimed& claimed);
std::vector<Finding> trajectory_findings(const StudySummary& study);

}  // namespace vantage::bench
