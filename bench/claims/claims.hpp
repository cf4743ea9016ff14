/// Claims of the dissertation and goals of this project, each held against what was measured.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/tables/study_tables.hpp"

namespace vantage::bench {

enum class Verdict { yes, no, not_run };

struct Finding {
  std::string source;    ///< "Fig. 3.10", or the goal
  std::string claim;     ///< what should be seen
  std::string measured;  ///< what was, or what is missing
  Verdict verdict = Verdict::not_run;
  std::string why;  ///< what explains it, if it does not hold
};

struct Measured {
  std::string text;
  bool holds = false;
  std::string why = {};  ///< what explains it, if it does not
};

/// Holds a claim against what `measure` finds. It is not run where a number that it asks for is not
/// there, and says which.
Finding held(std::string source, std::string claim, const std::function<Measured()>& measure);

/// The claims as a table.
std::string findings_table(const std::vector<Finding>& findings);

/// Figures of benchmarks by the benchmark's name: decision, scaling, office, episode.
using Figures = std::map<std::string, Json>;

std::vector<Finding> speed_findings(const Figures& figures);
/// Of the studies of chapter 3. @param studies their files, `results` those of sweep collect
std::vector<Finding> study_time_findings(const std::filesystem::path& studies,
                                         const std::filesystem::path& results);
std::vector<Finding> tabletop_findings(const StudyTables& study);
std::vector<Finding> prediction_findings(const StudyTables& study);
/// Of recognition, alone and among others, and of change detection on the quadrotor.
std::vector<Finding> flight_recognition_findings(const StudyTables& study);
std::vector<Finding> clutter_findings(const StudyTables& study);
std::vector<Finding> flight_change_findings(const StudyTables& study);
/// Scans that the dissertation's best method takes.
struct ScansClaimed {
  int fewest = 0;
  int most = 0;
};
std::vector<Finding> office_findings(const StudyTables& study, const std::string& figure,
                                     const ScansClaimed& claimed);
/// Of an office. @param time_limit of the time to 95 % in terms of the reference's, `path_limit` of
/// the way
std::vector<Finding> planning_office_findings(const StudyTables& study, double time_limit,
                                              std::optional<double> path_limit);
std::vector<Finding> planning_tabletop_findings(const StudyTables& study);
/// Of what bench/bounds wrote of a study of planning.
Finding above_the_bound(const StudyTables& bounds);
/// Of explorations that end when the robot is sure to be done.
std::vector<Finding> stop_findings(const StudyTables& study);
/// Of budgets with the way home.
std::vector<Finding> budget_findings(const StudyTables& study);
/// Of buildings with narrow doors and loops: the goals of this project.
std::vector<Finding> building_findings(const StudyTables& study);
std::vector<Finding> trajectory_findings(const StudyTables& study);
/// Of robots with faults.
std::vector<Finding> mapping_fault_findings(const StudyTables& study);
std::vector<Finding> recognition_fault_findings(const StudyTables& study);
std::vector<Finding> trajectory_fault_findings(const StudyTables& study);

}  // namespace vantage::bench
